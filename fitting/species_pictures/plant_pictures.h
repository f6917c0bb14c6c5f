// Pictures of many plants: tiles side by side with a line of text under each. Contact sheets of the species
// space and blend strips are made of them.
#pragma once
#include <string>
#include <vector>

#include <espalier/core/parameter_table.h>
#include <espalier/core/random.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/plant/model.h>

namespace espalier {

/// One plant and what is written under it.
struct PlantTile {
  ParameterValues values;
  std::string text;
  double least_frame_m = 0;  ///< side of the square it is seen in, at least
};

struct TileView {
  int size_px = 256;  ///< of a tile's square
  Seed seed = 1;      ///< of the plants
  GrowthBudget budget = {100'000,
                         500'000};  ///< more than this, a picture of some hundred pixels does not show
};

/// The side in metres of a square that holds a plant with its base in the middle of the bottom, as fits frame
/// it.
double frame_m(const Plant& plant);

/// Rows of tiles of shaded plants on white. A plant beyond the budget is thinned. The same bits
/// for any number of threads.
Picture tile_picture(const Model& model, const std::vector<std::vector<PlantTile>>& rows,
                     const TileView& view);

/// A strip of `strip` as tiles with t under them. The frame zooms evenly from end to end, but holds every
/// tree.
std::vector<PlantTile> strip_tiles(const Model& model, const std::vector<ParameterValues>& strip,
                                   const std::string& title, Seed seed);

/// A small shaded plant with the share of each pixel that it covers, to be laid over something else.
struct CutOutPlant {
  Picture picture;
  std::vector<std::uint8_t> cover;  ///< 0 … 255 a pixel
};

CutOutPlant cut_out_plant(const Model& model, const ParameterValues& values, const TileView& view);

}  // namespace espalier
