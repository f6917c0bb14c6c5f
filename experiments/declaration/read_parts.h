// The readers of an experiment's three kinds. They throw InputError with file, line, key, got and expected.
#pragma once
#include <espalier/core/toml/toml_section.h>
#include <espalier/experiments/declaration/experiment.h>

namespace espalier {

FitsDeclaration read_fits(const TomlSection& fits);
PicturesDeclaration read_pictures(const TomlSection& pictures);
GrowthDeclaration read_growth(const TomlSection& growth);

}  // namespace espalier
