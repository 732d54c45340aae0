// What a call throws, for tests that judge the message.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace hooke::test {

/// The message of the exception of exactly type E that `call` throws; a failed test and "" if it throws none.
template <typename E, typename Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const E& error) {
    EXPECT_EQ(typeid(error), typeid(E)) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

/// Whether `text` contains `part`.
inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace hooke::test

/// The call throws Type and its message begins with `start`.
#define EXPECT_ERROR(Type, start, ...)                                                         \
  do {                                                                                         \
    const std::string message = ::hooke::test::message_of<Type>([&] { (void)(__VA_ARGS__); }); \
    EXPECT_EQ(message.substr(0, std::string(start).size()), start) << message;                 \
    EXPECT_EQ(message.find('\n'), std::string::npos);                                          \
  } while (false)
