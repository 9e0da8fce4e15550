#pragma once
/// Output that drives no terminal, whatever text it is given: a name, a manifest or a file may hold escape sequences.

#include <ostream>
#include <streambuf>

namespace thinwall {

/// Hands letters on to `out`. Of control characters the end of a line and the tab pass; others are spelled out, `\x1b` or, where
/// JSON may hold them, `\u009b`, which stays JSON and means the same.
class HarmlessOutput final : public std::ostream {
 public:
  explicit HarmlessOutput(std::ostream& to) : std::ostream(nullptr), buffer_(to) { rdbuf(&buffer_); }

 private:
  class Buffer final : public std::streambuf {
   public:
    explicit Buffer(std::ostream& out) : out_(out) {}

   private:
    int_type overflow(int_type value) override;
    int sync() override;

    std::ostream& out_;
    bool after_c2_ = false;  // the first byte of U+0080 to U+00BF in UTF-8 was held back
  };

  Buffer buffer_;
};

}  // namespace thinwall
