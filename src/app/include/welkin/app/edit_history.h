#pragma once
// Undo and redo of whole values (a scene is a few kilobytes): the panel changes a copy, pushes it, and gets it back.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace welkin::app {

template <class T>
class EditHistory {
 public:
  explicit EditHistory(T first, std::size_t most = 200) : most_(std::max<std::size_t>(most, 1)) {
    states_.push_back({std::move(first), {}});
  }

  // The value after an edit of `what` ("sun elevation"). While one widget is dragged its edits are one: a push of the same `what` takes the
  // place of the last until settle(), undo or another `what`.
  void push(T value, const std::string& what) {
    states_.erase(states_.begin() + std::ptrdiff_t(at_) + 1, states_.end());  // what was undone is gone
    if (open_ && at_ > 0 && states_[at_].what == what) {
      states_[at_].value = std::move(value);
      return;
    }
    states_.push_back({std::move(value), what});
    if (states_.size() > most_ + 1) states_.erase(states_.begin());
    at_ = states_.size() - 1;
    open_ = true;
  }
  void settle() { open_ = false; }  // the widget was let go

  const T& current() const { return states_[at_].value; }
  bool canUndo() const { return at_ > 0; }
  bool canRedo() const { return at_ + 1 < states_.size(); }
  const std::string& undoes() const { return states_[at_].what; }  // empty: nothing
  std::string redoes() const { return canRedo() ? states_[at_ + 1].what : std::string(); }
  // The value to show; at an end the current one.
  const T& undo() {
    open_ = false;
    if (canUndo()) --at_;
    return current();
  }
  const T& redo() {
    open_ = false;
    if (canRedo()) ++at_;
    return current();
  }

 private:
  struct State {
    T value;
    std::string what;  // the edit that led here
  };
  std::size_t most_, at_ = 0;
  std::vector<State> states_;
  bool open_ = false;
};

}  // namespace welkin::app
