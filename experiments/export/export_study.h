// A study of fits for the tools that optimisers are compared with elsewhere: a folder a method, in which each
// target is a function, each seed an instance, and the value is 1 - fitness, which is minimised and 0 at
// best.
//   iohprofiler  IOHanalyzer (Wang et al., "IOHanalyzer: Detailed performance analyses for iterative
//   optimization
//                heuristics", ACM Trans. Evol. Learn. Optim. 2, 2022): .info and .dat as its readFiles.R
//                reads them
//   coco         COCO's post-processing (Hansen et al., "COCO: a platform for comparing continuous optimizers
//   in a
//                black-box setting", Optim. Methods Softw. 36, 2021): .info, .dat and .tdat, data_format
//                'bbob-new'
// Traces know what a batch reached, not its members. Both tools want a value after the first evaluation: it
// is 1, no likeness at all.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace espalier {

/// "iohprofiler", "coco".
std::vector<std::string> export_formats();

/// Makes `out` and what is in it; a page there says which function is which target. Returns the folders
/// of the methods. Throws InputError where the study is none of fits or nothing in it is done, where its
/// objectives differ (each would be its own judge), where runs do not say how many parameters were searched,
/// and where `out` holds files.
std::vector<std::filesystem::path> export_study(const std::filesystem::path& study, const std::string& format,
                                                const std::filesystem::path& out);

}  // namespace espalier
