#pragma once
// An OpenGL 4.5 core context: one of its own without a window (EGL), or that of somebody's window. Debug messages are counted; the first
// ones are kept to be shown.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "welkin/core/result.h"

namespace welkin::gpu {

struct DeviceInfo {
  std::string renderer, version, vendor;
  bool software = false;
};

class Context {
 public:
  // `choice`: "auto" (a hardware device if EGL finds one, else software), "software", or a device index.
  static Result<std::unique_ptr<Context>> createHeadless(const std::string& choice = "auto", bool debug = true);
  // Of the GL that is current in this thread, whoever made it and will end it. Fails if it is older than 4.5.
  static Result<std::unique_ptr<Context>> ofCurrent();
  ~Context();
  const DeviceInfo& device() const { return device_; }
  std::uint64_t debugMessages() const { return debugMessages_; }             // errors, undefined behaviour and warnings so far
  const std::vector<std::string>& firstMessages() const { return messages_; }
  void countMessage(std::string text);
  // To be called, with it current, once large objects were deleted: a driver keeps what the last dispatch was given until the
  // next one, with all of its memory. This one is given nothing.
  static void letGo();

 private:
  Context() = default;
  void begin(bool debug);  // of the current GL: says what it is, counts its messages
  void* display_ = nullptr;
  void* context_ = nullptr;
  DeviceInfo device_;
  std::uint64_t debugMessages_ = 0;
  std::vector<std::string> messages_;
};

}  // namespace welkin::gpu
