#pragma once
// Runs a command line in this process and keeps what it prints.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "welkin/app/cli.h"

namespace welkin::test {

struct Ran {
  int exit;
  std::string out, err;
};
inline Ran run(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "welkin");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = app::runProgram(int(arguments.size()), arguments.data());
  std::fflush(stdout);
  return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

}  // namespace welkin::test
