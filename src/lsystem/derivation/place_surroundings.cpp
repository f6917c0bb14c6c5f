#include <algorithm>

#include <espalier/lsystem/derivation/place_surroundings.h>

namespace espalier::lsystem {

namespace {

Position place_in(const VolumeDeclaration& declaration, std::size_t offset) {
  return {declaration.position.source, declaration.position.offset + offset};
}

/// The numbers of a tree in the order in which make_volume asks for them.
void collect_numbers(const VolumeTree& tree, const VolumeDeclaration& declaration,
                     std::deque<Expression>& texts) {
  for (const VolumeTree::Number& number : tree.numbers)
    texts.push_back({number.text, place_in(declaration, number.offset)});
  for (const VolumeTree& part : tree.parts) collect_numbers(part, declaration, texts);
}

}  // namespace

SurroundingsMaker::SurroundingsMaker(RuleContext& shared) : shared_(shared) {
  for (const VolumeDeclaration& declaration : shared.grammar.volumes) {
    VolumeEntry& entry = volumes_.emplace_back(VolumeEntry{&declaration, {}, {}, nullptr});
    collect_numbers(declaration.tree, declaration, entry.texts);
    for (const Expression& text : entry.texts)
      entry.numbers.emplace_back(text, std::span<const std::string>(), false, shared);
  }
  for (const FieldDeclaration& declaration : shared.grammar.fields) {
    FieldEntry& entry = fields_.emplace_back(FieldEntry{&declaration, {}});
    for (const Expression& text : declaration.frame)
      entry.numbers.emplace_back(text, std::span<const std::string>(), false, shared);
  }
}

void SurroundingsMaker::replace(const std::string& name, VolumePtr volume) {
  const auto found = std::find_if(volumes_.begin(), volumes_.end(),
                                  [&](const VolumeEntry& entry) { return entry.declaration->name == name; });
  if (found != volumes_.end()) {
    found->replaced = std::move(volume);
    return;
  }
  if (volume)
    throw_input_error("{}: got a volume for '{}', expected one for {}", shared_.grammar.name, name,
                      volumes_.empty() ? "none: the L-system declares no volumes"
                                       : fmt::format("{}", fmt::join(shared_.grammar.names.volumes, ", ")));
}

void SurroundingsMaker::clear() {
  shared_.surroundings.volumes.clear();
  shared_.surroundings.fields.clear();
}

VolumePtr SurroundingsMaker::make(VolumeEntry& entry, const Evaluate& evaluate) {
  if (entry.replaced) return entry.replaced;
  std::size_t next = 0;
  const auto& names = shared_.grammar.names.volumes;
  try {
    return make_volume(
        entry.declaration->tree, [&](const VolumeTree::Number&) { return evaluate(entry.numbers[next++]); },
        [&](const std::string& name) {
          return shared_.surroundings.volumes.at(names.find(name).value_or(names.size()));
        });
  } catch (const VolumeError& error) {
    throw_at(place_in(*entry.declaration, error.offset), "{}", error.what());
  }
}

void SurroundingsMaker::make_after(std::size_t constants, const Evaluate& evaluate) {
  for (VolumeEntry& entry : volumes_)
    if (entry.declaration->constants_before == constants)
      shared_.surroundings.volumes.push_back(make(entry, evaluate));
  for (FieldEntry& entry : fields_) {
    if (entry.declaration->constants_before != constants) continue;
    const double x = evaluate(entry.numbers[0]), y = evaluate(entry.numbers[1]),
                 width = evaluate(entry.numbers[2]);
    if (!(width > 0))
      throw_at(entry.declaration->frame[2].position, "field '{}': got width {}, expected one above 0",
               entry.declaration->name, width);
    shared_.surroundings.fields.push_back({entry.declaration->picture, x, y, width});
  }
}

}  // namespace espalier::lsystem
