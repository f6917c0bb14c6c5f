// The parameters of the model of Weber and Penn (SIGGRAPH 95) as extended in the 2017 dissertation
// [CH, Appendix C], as a plain struct for growing and as a table for everything else.
// Metres and degrees. A LevelValues holds one value for each level of branching, trunk = 0; levels
// above 3 use the values of level 3. The defaults are the quaking aspen's [CH §3.2].
#pragma once
#include <array>
#include <span>

#include <espalier/core/parameter_table.h>
#include <espalier/weber_penn/table/along_curves.h>

namespace espalier {

using LevelValues = std::array<float, 4>;

struct WeberPennParameters {
  float shape = 7, shape_2 = 7, shape_mix = 0;
  float g_scale = 13, g_scale_v = 3;
  float levels = 3;
  float ratio = 0.015f, ratio_power = 1.2f;
  float flare = 0.6f;
  float base_splits = 0;
  LevelValues base_size{0.3f, 0.02f, 0.02f, 0.02f};
  LevelValues down_angle{0, 60, 60, 45}, down_angle_v{0, -50, 20, 30};
  LevelValues rotate{0, 140, 140, 77}, rotate_v{0, 0, 0, 0};
  LevelValues branches{1, 50, 30, 1};
  LevelValues length{1, 0.3f, 0.6f, 0}, length_v{0, 0, 0, 0};
  LevelValues taper{1, 1, 1, 1};
  LevelValues seg_splits{0, 0, 0, 0};
  LevelValues split_angle{40, 0, 0, 0}, split_angle_v{5, 0, 0, 0};
  LevelValues curve_res{5, 5, 5, 0};
  LevelValues curve{0, -40, -60, 0}, curve_back{0, 0, 0, 0}, curve_v{20, 100, 100, 0};
  LevelValues bend_v{0, 50, 0, 0};
  LevelValues branch_dist{0, 0, 0, 0};
  LevelValues radius_mod{1, 1, 1, 1};
  float leaf_blos_num = 40;
  float leaf_shape = 3, leaf_scale = 0.17f, leaf_scale_x = 1, leaf_bend = 0.6f;
  float blossom_shape = 1, blossom_scale = 0, blossom_rate = 0;
  float tropism_x = 0, tropism_y = 0, tropism_z = 0.5f;
  float prune_ratio = 0, prune_width = 0.5f, prune_width_peak = 0.5f;
  float prune_power_low = 0.5f, prune_power_high = 0.5f;
  float relaxed_counts = 0;
  float least_radius_mm = 5;  ///< in millimetres: not of the tree's size, as what is in metres is
  float crown_use = 0;
  float crown_top = 1, crown_top_x = 0, crown_top_y = 0;
  float crown_bottom = 0.3f, crown_bottom_x = 0, crown_bottom_y = 0;
  float crown_radius_right = 0.3f, crown_radius_back = 0.3f, crown_radius_left = 0.3f,
        crown_radius_front = 0.3f;
  float crown_rim_right = 0.4f, crown_rim_back = 0.4f, crown_rim_left = 0.4f, crown_rim_front = 0.4f;
  float crown_shape_above = 2, crown_shape_below = 2;
  StemCurves curves;  ///< along stems; the table's last rows

  int level_count() const { return static_cast<int>(levels); }
};

/// The levels 0..3 whose values describe level `level`: levels above 3 use those of level 3.
inline int level_index(int level) { return level < 3 ? level : 3; }

const ParameterTable& weber_penn_table();

/// `values` in the order of weber_penn_table().
WeberPennParameters weber_penn_parameters(std::span<const double> values);

}  // namespace espalier
