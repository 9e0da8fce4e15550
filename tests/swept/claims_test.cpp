// What every method of the list claims, on random motions of every pair that it serves: 24 000 in double, 12 000 in float.
// RC_PARAMS="max_success=1000" makes it ten times as many.

#include <gtest/gtest.h>

#include "support/claims_judge.hpp"

namespace thinwall::testing {
namespace {

TEST(Claims, are_kept_on_every_pair_in_double) { check_every_pair<double>(2000); }
/// Computed in double: the answer must be no later after it is rounded to float.
TEST(Claims, are_kept_on_every_pair_in_float) { check_every_pair<float>(1000); }

}  // namespace
}  // namespace thinwall::testing
