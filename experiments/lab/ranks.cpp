#include <thinwall/experiments/lab/runner.hpp>

#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>

#ifdef THINWALL_MPI
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>
#endif

namespace thinwall {
namespace {

/// The number in the first of the two variables that there is.
int number_in(const char* open_mpi, const char* others, int without) {
  for (const char* name : {open_mpi, others}) {
    const char* const text = std::getenv(name);
    const auto number = parse_count(text ? text : "");
    if (number && *number >= 0 && *number <= std::numeric_limits<int>::max()) return static_cast<int>(*number);
  }
  return without;
}

}  // namespace

Launch launch_of_this_process() {
  const Launch launch = {.rank = number_in("OMPI_COMM_WORLD_RANK", "PMI_RANK", 0),
                         .count = number_in("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", 1),
                         .neighbors = number_in("OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", 1)};
  return launch.rank < launch.count ? launch : Launch{};  // what somebody left in the environment
}

#ifdef THINWALL_MPI

Ranks::Ranks(const Launch& launch) : launch_(launch) {
  if (launch_.count <= 1) return;
  MPI_Init(nullptr, nullptr);
  joined_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &launch_.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &launch_.count);
  if (launch_.count == launch.count) return;
  MPI_Finalize();
  throw UsageError(
      fmt::format("started as one of {} processes, but MPI as built in counts {}: start it by that MPI's own mpirun",
                  launch.count, launch_.count));
}

Ranks::~Ranks() {
  if (joined_) MPI_Finalize();
}

int Ranks::worst(int status) const {
  if (!joined_) return status;
  int worst = status;
  MPI_Allreduce(&status, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return worst;
}

void Ranks::share(std::vector<std::uint8_t>& bytes) const {
  if (!joined_) return;
  MPI_Bcast(bytes.data(), static_cast<int>(bytes.size()), MPI_UINT8_T, 0, MPI_COMM_WORLD);
}

#else

Ranks::Ranks(const Launch& launch) : launch_(launch) {
  if (launch_.count <= 1) return;
  throw UsageError(fmt::format(
      "started as one of {} processes by mpirun, but this program was built without MPI; run it alone, or cut the run with "
      "--shard, or install MPI (Debian: libopenmpi-dev), configure with -DTHINWALL_MPI=ON and build again",
      launch_.count));
}

Ranks::~Ranks() = default;
int Ranks::worst(int status) const { return status; }
void Ranks::share(std::vector<std::uint8_t>&) const {}

#endif

}  // namespace thinwall
