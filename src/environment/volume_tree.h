// Volumes as text, in L-system files and on the command line: kinds with arguments, and volumes of volumes.
//   union(box(0,0,6, 12,12,12), crown(top = 14, radius = 3.5))
// A tree keeps its numbers as text with their place, because L-systems compute them (docs/lsystem.md). The
// kinds and their arguments are the rows of kKinds in volume_tree.cpp.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/environment/volume.h>

namespace espalier {

struct VolumeTree {
  /// A number as it is written.
  struct Number {
    std::string text;
    std::size_t offset = 0;
  };

  std::string kind;        ///< "box", or the name of a volume given elsewhere
  std::size_t offset = 0;  ///< where the kind starts in the text
  std::string file;        ///< of "mesh" and "picture"
  VolumePtr from_file;     ///< what it holds: a mesh in its size, a picture 1 m high
  std::vector<Number> numbers;
  std::vector<std::size_t> slots;  ///< of numbers that have names: which of the kind's each one is
  std::vector<VolumeTree> parts;
};

/// What is wrong with a volume, and where in its text.
struct VolumeError : InputError {
  VolumeError(std::size_t at, const std::string& message) : InputError(message), offset(at) {}
  std::size_t offset;
};

/// Where the files that a volume names are; throws InputError for those that may not be read.
using FindFile = std::function<std::filesystem::path(const std::string&)>;
using IsName = std::function<bool(std::string_view)>;

/// Reads the text and the files it names. `is_name` tells names that stand for volumes. Throws VolumeError.
VolumeTree parse_volume_tree(std::string_view text, const IsName& is_name, const FindFile& find_file);

using NumberOf = std::function<double(const VolumeTree::Number&)>;
using NamedVolume = std::function<VolumePtr(const std::string&)>;

/// The volume of a tree. Throws VolumeError where a number is none that its kind takes.
VolumePtr make_volume(const VolumeTree& tree, const NumberOf& number, const NamedVolume& named);

}  // namespace espalier
