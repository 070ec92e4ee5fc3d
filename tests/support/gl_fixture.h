#pragma once
// One headless GL context for the whole process, software by default (WELKIN_TEST_GPU=auto or a device index for another), and the
// promise that KHR_debug stays silent: a test that lets GL complain fails.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "welkin/gpu/context.h"

namespace welkin::test {

class GlEnvironment : public ::testing::Environment {
 public:
  // The context, made current on the first call; nullptr with a failure if there is none.
  static gpu::Context* context() {
    if (!slot()) {
      const char* choice = std::getenv("WELKIN_TEST_GPU");
      ::setenv("WELKIN_CACHE", "", 0);  // tests make what they test
      auto made = gpu::Context::createHeadless(choice ? choice : "software");
      if (!made.ok()) {
        ADD_FAILURE() << made.error().message;
        return nullptr;
      }
      slot() = std::move(*made);
    }
    return slot().get();
  }
  void TearDown() override { slot().reset(); }

 private:
  static std::unique_ptr<gpu::Context>& slot() {
    static std::unique_ptr<gpu::Context> made;
    return made;
  }
};

inline ::testing::Environment* const kGlEnvironment = ::testing::AddGlobalTestEnvironment(new GlEnvironment);

class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    context = GlEnvironment::context();
    ASSERT_NE(context, nullptr);
    messagesBefore_ = context->debugMessages();
  }
  void TearDown() override {
    if (!context) return;
    EXPECT_EQ(context->debugMessages(), messagesBefore_) << "KHR_debug must stay silent; among the first messages: "
                                                         << (context->firstMessages().empty() ? "" : context->firstMessages().back());
  }
  gpu::Context* context = nullptr;

 private:
  std::uint64_t messagesBefore_ = 0;
};

}  // namespace welkin::test
