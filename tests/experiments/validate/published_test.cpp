/// The published queries themselves, where they are at hand: no false negative and no false positive.

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include <thinwall/experiments/validate/validate.hpp>

namespace thinwall {
namespace {

std::filesystem::path published_folder() {
  if (const char* const named = std::getenv("THINWALL_CCD_QUERIES")) return named;
  const auto root = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path().parent_path();
  return root.parent_path() / "shared" / "data" / "ccd-queries";
}

TEST(PublishedQueries, are_all_answered_right) {
  const std::filesystem::path folder = published_folder();
  if (!std::filesystem::exists(folder)) {
    GTEST_SKIP() << "no published queries in " << folder.string()
                 << "; THINWALL_CCD_QUERIES may name the place, docs/validate.md says where to get them";
  }
  const Validation validation = validate(folder);
  const QueryCounts& total = validation.total;
  for (const std::string& wrong : validation.wrongs) ADD_FAILURE() << wrong;
  EXPECT_EQ(total.wrong(), 0);
  EXPECT_GT(total.checked, 0);
  EXPECT_EQ(total.read, total.checked + total.all_skipped());
  if (total.read != 7279) return;  // another selection
  EXPECT_EQ(total.checked, 1377);
  EXPECT_EQ(total.hits, 230);
  EXPECT_EQ(total.rounded, 77);
}

}  // namespace
}  // namespace thinwall
