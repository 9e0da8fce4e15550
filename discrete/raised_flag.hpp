#pragma once
/// A flag that is up while something goes on.

namespace thinwall {

/// Raises the flag, and puts it back as it was when its scope is left, by an exception too.
class RaisedFlag {
 public:
  explicit RaisedFlag(bool& flag) : flag_(&flag), before_(flag) { flag = true; }
  RaisedFlag(const RaisedFlag&) = delete;
  RaisedFlag& operator=(const RaisedFlag&) = delete;
  ~RaisedFlag() { *flag_ = before_; }

 private:
  bool* flag_;
  bool before_;
};

}  // namespace thinwall
