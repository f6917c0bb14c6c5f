// Tells the tree from its ground: by labels, by alpha, by luminance, or by the ground that the border shows.
#pragma once
#include <string>

#include <espalier/image/pictures/decode.h>
#include <espalier/image/separation/separation.h>
#include <espalier/image/separation/separation_options.h>

namespace espalier {

/// Throws InputError (opening with `name`) where the picture has one tone only, or has no alpha and the
/// method asks for it.
Separation separate_tree(const DecodedPicture& picture, const SeparationOptions& options,
                         const std::string& name);

}  // namespace espalier
