// What rows and columns of a sheet of pictures change: how it is read, and which tree comes of it.
#pragma once
#include <string>
#include <vector>

#include <espalier/core/toml/toml_section.h>
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/models/preset.h>

namespace espalier {

/// Reads the tables of `key`, rows or columns of the sheet, whose species or L-system is known. Throws
/// InputError with file, line, key, got and expected.
std::vector<PictureChange> read_changes(const TomlSection& pictures, const std::string& key,
                                        const PicturesDeclaration& sheet);

/// A view as text that differs where it does.
std::string describe(const View& view);

/// The change without its label, in words.
std::string describe(const PictureChange& change);

/// A file that is not found from the working directory may lie beside the experiment's file, or with the
/// experiments that come with Espalier; where it is nowhere, as it is named.
std::string find_data(const TomlSection& section, const std::string& file);

/// The same of a preset's file; names of bundled presets as they are.
std::string find_species(const TomlSection& section, const std::string& name);

/// Closed meshes, found as find_data does. Throws InputError with the place of `key` where one is none.
std::vector<std::string> read_objects(const TomlSection& section, std::string_view key);

/// A row's and a column's changes together; the column's win, and objects of both are there.
PictureChange merged(const PictureChange& row, const PictureChange& column);

/// The tree of the sheet with this change's species or L-system, before `blend_with` and `set`.
Preset grown_in(const PicturesDeclaration& sheet, const PictureChange& change);

/// Throws InputError where what a row sets is none of a column's tree, or a tree cannot be blended.
void check_together(const TomlSection& pictures, const PicturesDeclaration& sheet);

}  // namespace espalier
