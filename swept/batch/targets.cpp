#include <thinwall/swept/batch/targets.hpp>

#include <stdexcept>

#include <hwy/highway.h>

namespace thinwall {
namespace {

std::vector<std::int64_t> targets() {
  std::vector<std::int64_t> out = hwy::SupportedAndGeneratedTargets();  // the lowest bit is the widest
  if (out.empty() || out.back() != HWY_STATIC_TARGET) out.push_back(HWY_STATIC_TARGET);
  return out;
}

std::int64_t& in_use() {
  static std::int64_t target = targets().front();
  return target;
}

}  // namespace

std::vector<std::string> vector_targets() {
  std::vector<std::string> names;
  for (const std::int64_t target : targets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

void use_vectors(const std::string& name) {
  for (const std::int64_t target : targets()) {
    if (!name.empty() && name != hwy::TargetName(target)) continue;
    hwy::GetChosenTarget().Update(target);
    in_use() = target;
    return;
  }
  std::string known;
  for (const std::string& one : vector_targets()) known += (known.empty() ? "" : ", ") + one;
  throw std::invalid_argument("thinwall batch: no vectors \"" + name + "\" on this machine; there are " + known);
}

std::string vectors_in_use() { return hwy::TargetName(in_use()); }

}  // namespace thinwall
