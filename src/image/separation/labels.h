// Pictures that hold labels, as segmentation networks and their training sets have them: each pixel the
// number or the colour of what it shows, in areas of one value without soft edges.
#pragma once
#include <optional>
#include <string>

#include <espalier/image/pictures/decode.h>
#include <espalier/image/separation/separation.h>
#include <espalier/image/separation/separation_options.h>

namespace espalier {

/// What a picture's labels say; nothing where it holds none, and none is asked for. Throws InputError
/// (opening with `name`), with a list of those that are there, where a label asked for is not, or where there
/// are several and none was chosen.
std::optional<Separation> separate_by_label(const DecodedPicture& picture, const std::string& label,
                                            const std::string& name);

}  // namespace espalier
