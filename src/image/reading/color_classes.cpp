#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include <espalier/image/reading/color_classes.h>

namespace espalier {

namespace {

constexpr double kLeastVariance = 2e-4;  ///< of a colour: the noise of a JPEG
constexpr int kRounds = 12;  ///< of expectation and maximisation; shares move by less than 1 % then
constexpr double kFirstShare = 0.8, kLeastShare = 0.05, kMostShare = 0.98;
constexpr double kSampleShare = 0.25;  ///< what a sample counts for at least, beside the mixture

ColorClass class_of(const Eigen::Vector3d& mean, const Eigen::Matrix3d& covariance) {
  return {mean, covariance.inverse(), std::log(covariance.determinant())};
}

/// The colours that are least like the class: the less likely half.
std::vector<double> weights_of_unlike_half(const ColorClass& known, std::span<const Eigen::Vector3d> colors) {
  std::vector<double> densities;
  for (const Eigen::Vector3d& color : colors) densities.push_back(known.log_density(color));
  std::vector<double> sorted = densities;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (double& density : densities) density = density <= *middle ? 1 : 0;
  return densities;
}

}  // namespace

double ColorClass::log_density(const Eigen::Vector3d& color) const {
  const Eigen::Vector3d offset = color - mean;
  return -0.5 * (offset.dot(inverse_covariance * offset) + log_determinant);
}

ColorClass color_class_of(std::span<const Eigen::Vector3d> colors, std::span<const double> weights) {
  double sum = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < colors.size(); ++i) {
    sum += weights[i];
    mean += weights[i] * colors[i];
  }
  mean /= sum;
  Eigen::Matrix3d covariance = kLeastVariance * Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < colors.size(); ++i)
    covariance += weights[i] / sum * (colors[i] - mean) * (colors[i] - mean).transpose();
  return class_of(mean, covariance);
}

double bhattacharyya_distance(const ColorClass& a, const ColorClass& b) {
  const Eigen::Matrix3d covariance = 0.5 * (a.inverse_covariance.inverse() + b.inverse_covariance.inverse());
  const Eigen::Vector3d offset = a.mean - b.mean;
  return offset.dot(covariance.inverse() * offset) / 8 +
         0.5 * (std::log(covariance.determinant()) - 0.5 * (a.log_determinant + b.log_determinant));
}

double TwoClasses::other_probability(const Eigen::Vector3d& color) const {
  const double odds =
      std::log(share_of_other / (1 - share_of_other)) + other.log_density(color) - known.log_density(color);
  return 1 / (1 + std::exp(std::clamp(-odds, -50.0, 50.0)));
}

TwoClasses split_colors(std::span<const Eigen::Vector3d> sample, std::span<const Eigen::Vector3d> mixed) {
  std::vector<Eigen::Vector3d> all(sample.begin(), sample.end());
  all.insert(all.end(), mixed.begin(), mixed.end());
  const double sample_weight =
      std::max(1.0, kSampleShare * static_cast<double>(mixed.size()) / static_cast<double>(sample.size()));
  std::vector<double> known_weights(all.size(), sample_weight), other_weights(mixed.size());

  TwoClasses classes;
  classes.share_of_other = kFirstShare;
  classes.known = color_class_of(sample, std::span(known_weights).first(sample.size()));
  classes.other = color_class_of(mixed, weights_of_unlike_half(classes.known, mixed));
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0;
    for (std::size_t i = 0; i < mixed.size(); ++i) {
      other_weights[i] = classes.other_probability(mixed[i]);
      known_weights[sample.size() + i] = 1 - other_weights[i];
      sum += other_weights[i];
    }
    if (sum == 0) break;
    classes.share_of_other = std::clamp(sum / static_cast<double>(mixed.size()), kLeastShare, kMostShare);
    classes.other = color_class_of(mixed, other_weights);
    classes.known = color_class_of(all, known_weights);
  }
  return classes;
}

}  // namespace espalier
