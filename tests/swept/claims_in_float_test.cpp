// The same for a float query, which is computed in double: the answer must be no later after it is rounded to float.

#include <gtest/gtest.h>

#include "support/claimed_properties.hpp"

namespace thinwall::testing {
namespace {

TEST(Claims, are_kept_on_every_pair_in_float) { check_every_pair<float>(2500); }

}  // namespace
}  // namespace thinwall::testing
