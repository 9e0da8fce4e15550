#include <thinwall/experiments/adapters/speaker.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace thinwall {

namespace {

using Clock = std::chrono::steady_clock;
constexpr int not_started = 127;  // as a shell says that a program is not there
constexpr std::size_t most_of_a_line = std::size_t(1) << 30;

/// Waits until one of them is ready, for no longer than to `end`; what is ready by then counts, as after a halt of this program.
template <std::size_t Count> bool ready(std::array<pollfd, Count>& asked, Clock::time_point end) {
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    const int count = ::poll(asked.data(), Count, static_cast<int>(std::clamp<decltype(left)>(left, 0, 1 << 30)));
    if (count > 0) return true;
    if (count == 0) return false;
    if (errno != EINTR) return true;  // what is wrong will show
  }
}

Clock::time_point after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

Speaker::Speaker(std::string name, std::vector<std::string> words, const std::filesystem::path& folder)
    : name_(std::move(name)), program_(words.front()) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::array<int, 2> in{}, out{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in.data()) != 0)
    give_up(fmt::format("cannot be asked ({})", std::strerror(errno)));
  to_ = in[1];
  if (::pipe2(out.data(), O_CLOEXEC) != 0) {
    ::close(in[0]);
    give_up(fmt::format("cannot be heard ({})", std::strerror(errno)));
  }
  from_ = out[0];
  process_ = ::fork();
  if (process_ == 0) {  // only what may be called after a fork of one thread of many
    ::setpgid(0, 0);    // Ctrl-C on the terminal is for us: an engine that it ended would be one that had died
    const int null = ::open("/dev/null", O_WRONLY);
    if (::chdir(folder.c_str()) == 0 && ::dup2(in[0], 0) == 0 && ::dup2(out[1], 1) == 1 && ::dup2(null, 2) == 2) {
      ::execvp(pointers[0], pointers.data());
    }
    ::_exit(not_started);
  }
  ::close(in[0]);
  ::close(out[1]);
  if (process_ < 0) give_up(fmt::format("cannot be started ({})", std::strerror(errno)));
}

Speaker::~Speaker() { end(); }

void Speaker::end() {
  for (int* descriptor : {&to_, &from_}) {
    if (*descriptor >= 0) ::close(std::exchange(*descriptor, -1));
  }
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
  process_ = -1;
}

void Speaker::give_up(const std::string& why) {
  end();
  throw SpeakerError(fmt::format("{} {}", name_, why));
}

void Speaker::has_died() {
  int status = 0;
  for (int tries = 0; tries < 100 && process_ > 0; ++tries) {  // it may take its time to end
    const pid_t ended = ::waitpid(process_, &status, WNOHANG);
    if (ended == process_) process_ = -1;
    if (ended != 0) break;
    ::poll(nullptr, 0, 1);
  }
  if (process_ < 0 && WIFEXITED(status) && WEXITSTATUS(status) == not_started)
    give_up(fmt::format("cannot be started: is {} installed?", program_));
  give_up("has died");
}

std::string Speaker::line(double seconds) {
  const Clock::time_point end = after(seconds);
  while (true) {
    if (const std::size_t length = heard_.find('\n'); length != std::string::npos) {
      std::string line = heard_.substr(0, length);
      heard_.erase(0, length + 1);
      return line;
    }
    if (from_ < 0) give_up("has ended");
    std::array<pollfd, 1> asked = {{{.fd = from_, .events = POLLIN, .revents = 0}}};
    if (!ready(asked, end)) give_up(fmt::format("has said nothing for {:g} s", seconds));
    listen();
  }
}

void Speaker::listen() {
  std::array<char, 65536> buffer{};
  const ssize_t count = ::read(from_, buffer.data(), buffer.size());
  if (count < 0 && errno == EINTR) return;
  if (count <= 0) has_died();
  heard_.append(buffer.data(), static_cast<std::size_t>(count));
  if (heard_.size() > most_of_a_line) give_up("goes on and on in one line");
}

nlohmann::json Speaker::hear(double seconds) {
  const std::string said = line(seconds);
  nlohmann::json answer = nlohmann::json::parse(said, nullptr, false);
  if (answer.is_discarded()) give_up(fmt::format("says what is not JSON: \"{}\"", said.substr(0, 60)));
  return answer;
}

nlohmann::json Speaker::ask(const nlohmann::json& question, double seconds) {
  const std::string asked = question.dump() + "\n";
  const Clock::time_point end = after(seconds);
  for (std::size_t sent = 0; sent < asked.size();) {
    if (to_ < 0) give_up("has ended");
    std::array<pollfd, 2> ends = {
        {{.fd = to_, .events = POLLOUT, .revents = 0}, {.fd = from_, .events = POLLIN, .revents = 0}}};
    if (!ready(ends, end)) give_up(fmt::format("has not listened for {:g} s", seconds));
    if (ends[1].revents != 0) listen();  // who cannot speak does not listen
    if (ends[0].revents == 0) continue;
    // a socket, unlike a pipe, says that nobody listens without a signal
    const ssize_t count = ::send(to_, asked.data() + sent, asked.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count <= 0) has_died();
    sent += static_cast<std::size_t>(count);
  }
  return hear(seconds);
}

}  // namespace thinwall
