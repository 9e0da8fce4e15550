#include <thinwall/experiments/accuracy/tally.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

#include <fmt/format.h>

namespace thinwall {

void ErrorHistogram::add(double error) {
  const double octave = error > 0 ? std::log2(error) + half_range : 0;
  const double bin = std::clamp(std::ceil(octave * bins_an_octave), 0.0, double{bins_an_octave} * octaves);
  ++bins_[static_cast<std::size_t>(bin)];
  largest_ = std::max(largest_, error);
}

void ErrorHistogram::add(const ErrorHistogram& other) {
  for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
  largest_ = std::max(largest_, other.largest_);
}

double ErrorHistogram::quantile(double share) const {
  std::int64_t total = 0, seen = 0;
  for (const std::int64_t count : bins_) total += count;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    seen += bins_[i];
    if (static_cast<double>(seen) < share * static_cast<double>(total)) continue;
    return std::min(largest_, i == 0 ? 0 : std::exp2(static_cast<double>(i) / bins_an_octave - half_range));
  }
  return 0;
}

std::string ErrorHistogram::to_text() const {
  std::string text = fmt::format("{:a}", largest_);
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    if (bins_[i] != 0) text += fmt::format(" {}:{}", i, bins_[i]);
  }
  return text;
}

ErrorHistogram ErrorHistogram::from_text(const std::string& text) {
  ErrorHistogram histogram;
  std::istringstream words(text);
  std::string word;
  words >> word;
  histogram.largest_ = std::stod(word);
  while (words >> word) {
    const std::size_t colon = word.find(':');
    histogram.bins_.at(std::stoul(word.substr(0, colon))) = std::stoll(word.substr(colon + 1));
  }
  return histogram;
}

void AccuracyTally::add(const AccuracyTally& other) {
  queries += other.queries;
  hits += other.hits;
  overlapping += other.overlapping;
  wrong_verdicts += other.wrong_verdicts;
  gave_up += other.gave_up;
  largest_wrong = std::max(largest_wrong, other.largest_wrong);
  forward.add(other.forward);
  backward.add(other.backward);
}

std::string AccuracyTally::to_line() const {
  return fmt::format("{} {} {} {} {} {:a};{};{}", queries, hits, overlapping, wrong_verdicts, gave_up, largest_wrong,
                     forward.to_text(), backward.to_text());
}

AccuracyTally AccuracyTally::from_line(const std::string& line) {
  AccuracyTally tally;
  const std::size_t first = line.find(';'), second = line.find(';', first + 1);
  std::istringstream counts(line.substr(0, first));
  std::string worst;
  counts >> tally.queries >> tally.hits >> tally.overlapping >> tally.wrong_verdicts >> tally.gave_up >> worst;
  tally.largest_wrong = std::stod(worst);
  tally.forward = ErrorHistogram::from_text(line.substr(first + 1, second - first - 1));
  tally.backward = ErrorHistogram::from_text(line.substr(second + 1));
  return tally;
}

}  // namespace thinwall
