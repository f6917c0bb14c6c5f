// Espalier, for who uses it as a library: grow a plant, draw it, compare it with a picture, fit it, export
// it. Each header below opens with what it holds; all others can be included by themselves just as well.
#pragma once

// Models: a table of parameters, and a function from values and a seed to a plant.
#include <espalier/core/error.h>
#include <espalier/core/parameter_table.h>
#include <espalier/core/random.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/overrides/overrides.h>
#include <espalier/plant/export.h>
#include <espalier/plant/model.h>
#include <espalier/plant/plant.h>

// Pictures: cameras, silhouettes by scan lines and by rays, shaded pictures.
#include <espalier/image/masks/mask.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/render/camera.h>
#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/grow_and_draw.h>
#include <espalier/render/scanlines/scanline_renderer.h>
#include <espalier/render/shading/shaded.h>

// Fits: pictures to fit, how alike two masks are, optimisers, blends, runs; posteriors.
#include <espalier/fitting/optimizers/search_method.h>
#include <espalier/fitting/posterior/posterior_run.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/fitting/species_space/blend.h>
#include <espalier/image/measures/compare.h>
#include <espalier/image/reading/read_target.h>
