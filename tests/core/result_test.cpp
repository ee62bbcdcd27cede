#include "core/result.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

namespace frustum {
namespace {

Result<int> half(int value) {
  if (value % 2 == 0) return value / 2;
  return error("odd");
}

TEST(Result, HoldsAValue) {
  const Result<int> result = half(8);
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(static_cast<bool>(result));
  EXPECT_EQ(result.value(), 4);
  EXPECT_EQ(*result, 4);
}

TEST(Result, HoldsTheDiagnosticsThatSayWhyThereIsNoValue) {
  const Result<int> result = half(7);
  ASSERT_FALSE(result.has_value());
  ASSERT_EQ(result.error().size(), 1U);
  EXPECT_EQ(result.error().front().message, "odd");
}

TEST(Result, TakesSeveralDiagnostics) {
  const Result<std::string> result = Diagnostics{warning("w"), error("a"), error("b")};
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().size(), 3U);
}

TEST(Result, ReachesMembersThroughTheArrow) {
  Result<std::string> result = std::string("abc");
  EXPECT_EQ(result->size(), 3U);
  result->push_back('d');
  EXPECT_EQ(*result, "abcd");
}

TEST(Result, HandsOutMoveOnlyValues) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(5);
  const std::unique_ptr<int> owned = std::move(result).value();
  EXPECT_EQ(*owned, 5);
}

TEST(Result, AndThenRunsOnlyOnAValue) {
  EXPECT_EQ(half(12).and_then(half).value(), 3);
  int calls = 0;
  const auto counted = [&calls](int value) {
    ++calls;
    return half(value);
  };
  const Result<int> failed = half(7).and_then(counted);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().front().message, "odd");
  EXPECT_EQ(calls, 0);
  EXPECT_FALSE(half(6).and_then(counted));
  EXPECT_EQ(calls, 1);
}

TEST(Result, TransformChangesTheTypeAndKeepsTheFailure) {
  const auto name = [](int value) { return std::to_string(value); };
  EXPECT_EQ(half(8).transform(name).value(), "4");
  const Result<std::string> failed = half(3).transform(name);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().front().message, "odd");
}

}  // namespace
}  // namespace frustum
