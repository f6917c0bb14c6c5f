// Kinds of trees: what a picture shows, and what a fit is told to look for.
#pragma once
#include <espalier/core/names.h>

namespace espalier {

/// What a picture shows [fitting/picture/picture_reading.h].
enum class TreeKind { leafy, leafless, palm };

template <>
inline constexpr auto kNames<TreeKind> = std::to_array<Name<TreeKind>>({{TreeKind::leafy, "leafy"},
                                                                        {TreeKind::leafless, "leafless"},
                                                                        {TreeKind::palm, "palm"}});

/// What a fit looks for. automatic: what the picture shows; any: trees with leaves and without.
enum class KindChoice { automatic, any, leafy, leafless, palm };

template <>
inline constexpr auto kNames<KindChoice> = std::to_array<Name<KindChoice>>({{KindChoice::automatic, "auto"},
                                                                            {KindChoice::any, "any"},
                                                                            {KindChoice::leafy, "leafy"},
                                                                            {KindChoice::leafless,
                                                                             "leafless"},
                                                                            {KindChoice::palm, "palm"}});

/// To look for what a picture shows.
inline KindChoice choice_of(TreeKind kind) {
  switch (kind) {
    case TreeKind::leafy:
      return KindChoice::leafy;
    case TreeKind::leafless:
      return KindChoice::leafless;
    case TreeKind::palm:
      return KindChoice::palm;
  }
  throw InternalError("unknown kind of tree");
}

/// The one kind that a choice asks for; nothing where it leaves that open.
inline std::optional<TreeKind> stated_kind(KindChoice choice) {
  for (const Name<TreeKind>& row : kNames<TreeKind>)
    if (choice_of(row.value) == choice) return row.value;
  return std::nullopt;
}

}  // namespace espalier
