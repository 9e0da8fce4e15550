#pragma once
/// The processes that `mpirun` started together, of which this is one. A process that was started alone is rank 0 of 1.

#include <cstdint>
#include <vector>

namespace thinwall {

/// What mpirun says in the environment, with MPI built in or not.
struct Launch {
  int rank = 0;
  int count = 1;
  int neighbors = 1;  ///< ranks on this machine, this one included
};
Launch launch_of_this_process();

/// Takes part in MPI from construction to destruction, at most once in a process; does nothing where the launch is of
/// one rank. Throws UsageError if this program was built without MPI and has company.
class Ranks {
 public:
  explicit Ranks(const Launch& launch);
  ~Ranks();  // NOLINT(performance-trivially-destructible): not where it has MPI to leave
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return launch_.rank; }
  int count() const { return launch_.count; }

  // All ranks must call these, in the same order.
  int worst(int status) const;                         ///< the largest that any rank calls it with
  void share(std::vector<std::uint8_t>& bytes) const;  ///< gives every rank those of rank 0

 private:
  Launch launch_;
  bool joined_ = false;
};

}  // namespace thinwall
