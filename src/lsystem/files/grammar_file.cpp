#include <espalier/lsystem/files/grammar_file.h>
#include <espalier/lsystem/files/grow_copied.h>
#include <espalier/lsystem/notation/parse_grammar.h>

namespace espalier::lsystem {

namespace fs = std::filesystem;

namespace {

/// Grows the plants that the file declares.
Grammar with_plants(Grammar grammar) {
  auto appearance = std::make_shared<Appearance>(*grammar.appearance);
  Limits left = kCopiedLimits;
  for (NamedSurface& surface : appearance->surfaces)
    if (surface.declared) surface.plant = grow_copied(*surface.declared, left);
  grammar.appearance = std::move(appearance);
  return grammar;
}

}  // namespace

Grammar read_grammar(const std::string& path, bool may_have_plants,
                     const std::shared_ptr<ReadSoFar>& so_far) {
  const fs::path file = path;
  const auto counts = so_far ? so_far : std::make_shared<ReadSoFar>();
  std::string text = read_text(file, *counts);
  const auto files = std::make_shared<ReadFiles>(ReadFiles{file});
  const auto source = std::make_shared<Source>(
      Source{path, file.parent_path(), std::move(text), true, may_have_plants, files, counts});
  Grammar grammar = with_plants(parse_statements(source, file.stem().string(), true));
  grammar.files = *source->files;
  return grammar;
}

Grammar parse_grammar(const std::string& text, const std::string& label, const fs::path& folder) {
  const auto source = std::make_shared<Source>(Source{label, folder, text, !folder.empty()});
  return with_plants(parse_statements(source, fs::path(label).stem().string(), false));
}

}  // namespace espalier::lsystem
