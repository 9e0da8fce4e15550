#pragma once
/// Which vectors batches use.

#include <string>
#include <vector>

namespace thinwall {

/// The instruction sets that batches are built for and that this machine has, the widest first: "AVX3" is AVX-512. The
/// last is scalar code and always there.
std::vector<std::string> vector_targets();

/// Makes batches use the target of that name from now on, in every thread; "" is the widest again. Throws std::invalid_argument
/// for one that vector_targets() does not name. For tests and benchmarks: call it while no batch runs.
void use_vectors(const std::string& name);

/// The one in use.
std::string vectors_in_use();

}  // namespace thinwall
