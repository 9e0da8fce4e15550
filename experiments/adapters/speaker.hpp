#pragma once
/// A program that is asked, and answers, in lines of JSON: an engine that lives in another language.

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace thinwall {

/// It died, hung, or said what is not JSON. what() says which, after the name it was given; it is not asked again.
struct SpeakerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One process, ended with this object. Not for two threads at once.
class Speaker {
 public:
  /// Starts `words` in `folder`; `name` is how messages call it. Throws SpeakerError.
  Speaker(std::string name, std::vector<std::string> words, const std::filesystem::path& folder);
  ~Speaker();
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  /// Its next line. Throws SpeakerError, also if none has come within `seconds`; the process has ended then.
  nlohmann::json hear(double seconds);
  /// Its answer to a line. Throws as hear() does.
  nlohmann::json ask(const nlohmann::json& question, double seconds);

 private:
  [[noreturn]] void give_up(const std::string& why);
  [[noreturn]] void has_died();
  void end();
  void listen();
  std::string line(double seconds);

  std::string name_, program_;
  int process_ = -1, to_ = -1, from_ = -1;
  std::string heard_;  ///< of a line that is not whole yet, or of the next
};

}  // namespace thinwall
