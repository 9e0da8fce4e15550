#include <thinwall/experiments/validate/validate.hpp>

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include <thinwall/experiments/text/escape.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_wrongs = 20;
constexpr int timed_calls = 32;

std::string family_name(const fs::path& folder, const fs::path& file, Primitives primitives) {
  fs::path family;
  for (const fs::path& part : file.lexically_relative(folder).parent_path()) {
    if (part != name(primitives)) family /= part;
  }
  return family.empty() ? "." : one_line(family.generic_string());
}

double nanoseconds_a_call(const RigidQuery& query) {
  using Clock = std::chrono::steady_clock;
  volatile double sink = 0;
  const Clock::time_point start = Clock::now();
  for (int call = 0; call < timed_calls; ++call) {
    const Toi<double> toi = library_answer(query);
    sink = sink + toi.time + toi.normal[0] + toi.point[0];
  }
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count() / timed_calls;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Counts one answer and says what is wrong with it; nothing if all agree.
std::string judge(ToiStatus status, bool exact, bool published, QueryCounts& counts) {
  const bool hit = status == ToiStatus::hit || status == ToiStatus::overlapping;
  counts.hits += exact;
  std::string wrong;
  if (exact != published) {
    ++counts.file_differs;
    wrong += fmt::format("the file says {}, exact arithmetic {}; ", published ? "hit" : "miss", exact ? "hit" : "miss");
  }
  if (status == ToiStatus::gave_up || status == ToiStatus::invalid) {
    ++counts.undecided;
    wrong += "the library gives no verdict; ";
  } else if (!hit && (exact || published)) {
    ++counts.false_negatives;
    wrong += "false negative; ";
  } else if (hit && !(exact && published)) {
    ++counts.false_positives;
    wrong += "false positive; ";
  }
  return wrong.substr(0, wrong.empty() ? 0 : wrong.size() - 2);
}

}  // namespace

QueryCounts& QueryCounts::operator+=(const QueryCounts& other) {
  read += other.read;
  checked += other.checked;
  hits += other.hits;
  rounded += other.rounded;
  for (std::size_t i = 0; i < skipped.size(); ++i) skipped[i] += other.skipped[i];
  false_negatives += other.false_negatives;
  false_positives += other.false_positives;
  undecided += other.undecided;
  file_differs += other.file_differs;
  return *this;
}

Validation validate(const fs::path& folder) {
  Validation out;
  std::vector<double> times;
  for (const fs::path& file : query_files(folder)) {
    QueryFile queries(file);
    const Primitives primitives = queries.primitives();
    QueryCounts counts;
    while (const auto published = queries.next()) {
      ++counts.read;
      const RigidReading reading = read_rigid(primitives, *published);
      if (!reading.query) {
        ++counts.skipped[static_cast<std::size_t>(reading.skipped)];
        continue;
      }
      ++counts.checked;
      counts.rounded += reading.query->rounded;
      const std::string wrong = judge(library_answer(*reading.query).status, reading.query->posed_contact.has_value(),
                                      published->collides, counts);
      if (!wrong.empty() && out.wrongs.size() < most_wrongs) {
        out.wrongs.push_back(fmt::format("{}:{}: {}", one_line(file.string()), published->line, wrong));
      }
      times.push_back(nanoseconds_a_call(*reading.query));
    }
    const std::string family = family_name(folder, file, primitives);
    const bool known =
        !out.families.empty() && out.families.back().name == family && out.families.back().primitives == primitives;
    if (!known) out.families.push_back({family, primitives, {}});
    out.families.back().counts += counts;
    out.total += counts;
  }
  out.median_ns = median(std::move(times));
  return out;
}

}  // namespace thinwall
