// A growth sequence of an L-system: one picture after another from the axiom to the last step, all seen by
// one camera. Between two steps `fraction` runs from 0 to 1, for files whose interpretation uses it.
#pragma once
#include <string>

#include <espalier/app/options/view_options.h>
#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/render/shading/shaded.h>

namespace espalier {

struct GrowthFrames {
  int frames = 60;
  double seconds = 0.1;  ///< a frame of a GIF
  std::string output;    ///< .gif, or .png for NAME_000.png, NAME_001.png, …
};

/// Throws InputError unless the values can be used: to be called before anything costly is done.
void check_growth_frames(const GrowthFrames& options);

/// Draws the frames, with progress on stderr. After Ctrl-C: a GIF is not written, pictures written stay, and
/// the command ends with 130.
void write_growth_frames(lsystem::Derivation& derivation, const ParameterValues& values, Seed seed, int steps,
                         const ViewOptions& view, const ShadedSettings& shading, const GrowthFrames& options);

}  // namespace espalier
