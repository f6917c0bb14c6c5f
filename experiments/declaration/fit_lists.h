// The lists of an experiment of fits, every combination of whose values is a run: how they are read, what
// tables call a value, and what it is in words, which two values that are the same share.
#pragma once
#include <string>
#include <vector>

#include <espalier/core/toml/toml_section.h>
#include <espalier/experiments/declaration/experiment.h>

namespace espalier {

/// "oc_palm" and so on; none where they are not found.
std::vector<std::string> bundled_targets();

// Readers of keys that are there. They throw InputError, also where two values have one label.
void read_targets(const TomlSection& fits, FitsDeclaration& declaration);
void read_optimizers(const TomlSection& fits, FitsDeclaration& declaration);
void read_objectives(const TomlSection& fits, FitsDeclaration& declaration);
void read_spaces(const TomlSection& fits, FitsDeclaration& declaration);
void read_starts(const TomlSection& fits, FitsDeclaration& declaration);
void read_trained(const TomlSection& fits, FitsDeclaration& declaration);
void read_seeds(const TomlSection& fits, FitsDeclaration& declaration);
void read_groups_of_targets(const TomlSection& fits, FitsDeclaration& declaration);

std::string describe(const TargetDeclaration& target);
std::string describe(const OptimizerDeclaration& optimizer);
std::string describe(const SpaceDeclaration& space);

/// "AZIMUTH,ELEVATION" or with a field of view behind them. Throws InputError with the place of `key`.
View parse_angles(const TomlSection& section, std::string_view key, const std::string& text);

/// An L-system's file lies beside the experiment's or is named from the working directory; else the name of a
/// bundled one, or of another model.
std::string find_model(const TomlSection& section, const std::string& name);

/// An L-system by its file, found as find_model does, or a bundled one also without ".lsys". Throws
/// InputError with the place of `key` where there is none.
std::string find_lsystem(const TomlSection& section, std::string_view key, const std::string& name);

/// The space of an experiment that names none. `fits` says whether it names a growth budget.
SpaceDeclaration usual_space(const TomlSection& fits, const FitRecord& shared);

TargetGroups groups_in(const TomlSection& fits);

}  // namespace espalier
