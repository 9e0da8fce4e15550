#pragma once
/// A flag that is up while something goes on.

namespace thinwall {

/// Raises the flag, and lowers it when its scope is left, by an exception too.
class RaisedFlag {
 public:
  explicit RaisedFlag(bool& flag) : flag_(&flag) { *flag_ = true; }
  RaisedFlag(const RaisedFlag&) = delete;
  RaisedFlag& operator=(const RaisedFlag&) = delete;
  ~RaisedFlag() { *flag_ = false; }

 private:
  bool* flag_;
};

}  // namespace thinwall
