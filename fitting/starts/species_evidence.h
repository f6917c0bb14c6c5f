// Which species a picture may show. Of each species a few trees are drawn from the picture's side, and the
// picture is compared with them as they are with each other: a picture of the species is as unlike its trees
// as these are unlike each other, a picture of something else is more so.
#pragma once
#include <span>
#include <string>
#include <vector>

#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/starts/fit_plan.h>
#include <espalier/fitting/task/fit_task.h>

namespace espalier {

struct SpeciesEvidence {
  StartPoint species;            ///< as tall as the target
  double dissimilarity = 0;      ///< of the picture and the species' trees, in the mean
  double own_dissimilarity = 0;  ///< of two of its trees
  double probability = 0;        ///< among these species, each equally likely beforehand
};

/// Each bundled species of the model that the plan's kind allows, the likeliest first; none for models
/// without presets. Grows kTreesOfEvidence trees of each; the first view is looked at.
std::vector<SpeciesEvidence> species_evidence(const FitRecord& record, const FitTask& task,
                                              const FitPlan& plan);

inline constexpr int kTreesOfEvidence = 4;

/// "looks like small_pine (62 %), black_oak (21 %); its parameters are 0.8 spreads of species from small_pine's";
/// empty for none. Species of less than a tenth are left out, but for the first.
std::string species_in_words(std::span<const SpeciesEvidence> evidence, double departure);

/// Of species whose trees the picture is so much less like than they are like each other (an excess below 0
/// is none), where trees of one species vary by `sd`. Where even the best has an excess, the picture is
/// unlike all of them, and differences of that size say little: it is added to the variance.
std::vector<double> probabilities_of(std::span<const double> excesses, double sd);

}  // namespace espalier
