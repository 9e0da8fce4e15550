#include <thinwall/experiments/speed/bench_program.hpp>

#include <unistd.h>

#include <array>
#include <mutex>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include <thinwall/experiments/figures/subprocess.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/file_text.hpp>

namespace thinwall {

namespace {

namespace fs = std::filesystem;

/// A folder of our own, gone with this.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "thinwall-speed-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// The last line that is not empty, for a message.
std::string last_words(const std::string& output) {
  const std::size_t end = output.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return "it said nothing";
  const std::size_t before = output.find_last_of('\n', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return clipped(one_line(output.substr(begin, end + 1 - begin)), 300);
}

std::string how_to_build(const std::string& name) {
  if (name == "peers")
    return "configure with -DTHINWALL_PEERS=ON and build again (Debian: libbullet-dev libode-dev libfcl-dev libccd-dev)";
  return "configure with -DTHINWALL_BUILD_BENCH=ON and build again (Debian: libbenchmark-dev)";
}

}  // namespace

std::span<const std::string_view> bench_program_names() {
  static constexpr std::array<std::string_view, 7> names = {"pairs", "methods",     "certified", "batch",
                                                            "peers", "broad_phase", "world"};
  return names;
}

fs::path built_benchmarks() {
  std::error_code ignored;
  const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  const fs::path beside = here / "bench", above = here.parent_path() / "bench";
  return !fs::is_directory(beside, ignored) && fs::is_directory(above, ignored) ? above : beside;
}

bool is_program(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

BenchOutput run_bench_program(const fs::path& folder, const std::string& name, const BenchOptions& options) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const fs::path program = fs::absolute(folder) / name;
  if (!is_program(program)) {
    BenchOutput output;
    output.program = name;
    output.missing = fmt::format("it is not in the folder of the benchmarks: {}", how_to_build(name));
    return output;
  }
  const ScratchFolder scratch;
  const fs::path out = scratch.path() / "out.json";
  std::vector<std::string> words = {program.string(), fmt::format("--benchmark_min_time={}", options.seconds),
                                    "--benchmark_out=" + out.string(), "--benchmark_out_format=json"};
  if (!options.filter.empty()) words.push_back("--benchmark_filter=" + options.filter);
  const ProcessResult run = run_process(words, scratch.path());
  if (run.status == -1) throw std::runtime_error(fmt::format("{} was killed by a signal", program.string()));
  if (run.status != 0) {
    throw std::runtime_error(fmt::format("{} ended with status {}: {}", program.string(), run.status,  //
                                         last_words(run.output)));
  }
  try {
    const std::string json = file_text(out);
    if (json.empty() && !options.filter.empty()) return {name, "", {}, {}, {}};  // no row has the filter's text
    return bench_output_from_json(name, json);
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", program.string(), error.what()));
  }
}

}  // namespace thinwall
