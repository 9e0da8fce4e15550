#include <thinwall/experiments/broad_phase/lines.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <thinwall/experiments/random.hpp>

namespace thinwall {

TimeEstimate time_of(const Finding& finding) {
  const std::array<double, 1> key = {static_cast<double>(finding.milliseconds.size())};
  return {median(finding.milliseconds), bootstrap_median(finding.milliseconds, {1, stream_of(key)})};
}

const Finding* finding_of(const Survey& survey, const std::string& finder) {
  const auto found = std::find_if(survey.findings.begin(), survey.findings.end(),
                                  [&](const Finding& f) { return f.finder == finder; });
  return found == survey.findings.end() ? nullptr : &*found;
}

std::vector<Course> courses(const std::vector<SurveyLine>& lines) {
  std::vector<Course> all;
  for (const SurveyLine& line : lines) {
    for (const Finding& f : line.survey.findings) {
      const auto same = [&](const Course& c) {
        return c.finder == f.finder && c.factors.clustered == line.factors.clustered &&
               c.factors.speed == line.factors.speed;
      };
      auto course = std::find_if(all.begin(), all.end(), same);
      if (course == all.end()) course = all.insert(all.end(), {line.factors, f.finder, {}, {}});
      course->milliseconds.push_back({static_cast<double>(line.factors.count), median(f.milliseconds)});
    }
  }
  for (Course& c : all) {
    std::sort(c.milliseconds.begin(), c.milliseconds.end(),
              [](const GrowthPoint& a, const GrowthPoint& b) { return a.count < b.count; });
    std::vector<GrowthPoint> large = c.milliseconds;
    std::erase_if(large, [](const GrowthPoint& p) { return p.count < growth_from; });
    c.growth = fit_growth(large);
  }
  return all;
}

std::int64_t loop_is_best_up_to(const std::vector<SurveyLine>& lines) {
  std::map<std::int64_t, bool> best_at;  // by count: the half loop is quickest in every world of it
  for (const SurveyLine& line : lines) {
    const Finding* loop = finding_of(line.survey, "all_pairs");
    bool best = loop != nullptr;
    for (const Finding& f : line.survey.findings) {
      best = best && (&f == loop || median(loop->milliseconds) <= median(f.milliseconds));
    }
    const auto known = best_at.try_emplace(line.factors.count, true).first;
    known->second = known->second && best;
  }
  std::int64_t count = 0;
  for (const auto& [n, best] : best_at) {
    if (!best) break;
    count = n;
  }
  return count;
}

bool all_right(const std::vector<SurveyLine>& lines) {
  return std::all_of(lines.begin(), lines.end(), [](const SurveyLine& line) {
    const auto& findings = line.survey.findings;
    return std::all_of(findings.begin(), findings.end(), [](const Finding& f) { return f.is_right(); });
  });
}

}  // namespace thinwall
