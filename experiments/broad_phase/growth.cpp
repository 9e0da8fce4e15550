#include <thinwall/experiments/broad_phase/growth.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <boost/math/distributions/students_t.hpp>

namespace thinwall {

std::optional<Measured> fit_growth(std::span<const GrowthPoint> points) {
  const auto n = static_cast<double>(points.size());
  if (points.size() < 3) return std::nullopt;
  double mean_x = 0, mean_y = 0;
  for (const GrowthPoint& p : points) {
    mean_x += std::log(p.count) / n;
    mean_y += std::log(p.cost) / n;
  }
  double xx = 0, xy = 0;
  for (const GrowthPoint& p : points) {
    const double x = std::log(p.count) - mean_x;
    xx += x * x;
    xy += x * (std::log(p.cost) - mean_y);
  }
  if (!(xx > 0)) return std::nullopt;
  const double slope = xy / xx;
  double residual = 0;
  for (const GrowthPoint& p : points) {
    const double off = std::log(p.cost) - mean_y - slope * (std::log(p.count) - mean_x);
    residual += off * off;
  }
  const double error = std::sqrt(residual / (n - 2) / xx);
  const double reach = error * boost::math::quantile(boost::math::students_t(n - 2), 0.975);
  return Measured{slope, {slope - reach, slope + reach}};
}

std::vector<FindingRow> findings_of(const std::vector<SurveyRow>& rows) {
  std::vector<FindingRow> all;
  for (const SurveyRow& row : rows) {
    for (const Finding& finding : row.survey.findings) all.push_back({row.crowd, finding});
  }
  return all;
}

const Finding* finding_of(const Survey& survey, std::string_view finder) {
  const auto found = std::ranges::find(survey.findings, finder, &Finding::finder);
  return found == survey.findings.end() ? nullptr : &*found;
}

std::vector<Course> courses(const std::vector<SurveyRow>& rows) {
  const std::vector<FindingRow> findings = findings_of(rows);
  std::vector<Course> all;
  for (const auto& group : group_by(findings, [](const FindingRow& row) {
         return std::tuple(row.crowd.placement, row.crowd.speed, row.finding.finder);
       })) {
    std::vector<GrowthPoint> points;
    for (const FindingRow* row : group) {
      if (row->crowd.count >= growth_from)
        points.push_back({static_cast<double>(row->crowd.count), median(row->finding.milliseconds)});
    }
    std::ranges::sort(points, {}, &GrowthPoint::count);
    all.push_back({group[0]->crowd, group[0]->finding.finder, std::ssize(points), fit_growth(points)});
  }
  return all;
}

std::int64_t loop_is_best_up_to(const std::vector<SurveyRow>& rows) {
  std::map<std::int64_t, bool> best_at;  // by count: the half loop is quickest in every world of it
  for (const SurveyRow& row : rows) {
    const Finding* loop = finding_of(row.survey, "all_pairs");
    const bool best = loop != nullptr && std::ranges::all_of(row.survey.findings, [&](const Finding& f) {
                        return median(loop->milliseconds) <= median(f.milliseconds);
                      });
    best_at.try_emplace(row.crowd.count, true).first->second &= best;
  }
  std::int64_t count = 0;
  for (const auto& [n, best] : best_at) {
    if (!best) break;
    count = n;
  }
  return count;
}

bool all_right(const std::vector<SurveyRow>& rows) {
  return std::ranges::all_of(findings_of(rows), [](const FindingRow& row) { return row.finding.is_right(); });
}

}  // namespace thinwall
