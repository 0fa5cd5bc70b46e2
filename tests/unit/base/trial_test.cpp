#include "base/trial.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <stdexcept>

namespace {

using rotordrop::Trial;

Trial::End end_of(const std::function<void()>& work, const Trial::Limits& limits = {.seconds = 20}) {
  Trial trial(limits);
  trial.start(work);
  return trial.wait();
}

TEST(Trial, LeavesNoTraceHere) {
  int here = 1;
  EXPECT_EQ(end_of([&] { here = 2; }), Trial::End::done);
  EXPECT_EQ(here, 1);
}

TEST(Trial, AnErrorIsNoCrash) {
  EXPECT_EQ(end_of([] { throw std::runtime_error("refused"); }), Trial::End::done);
}

TEST(Trial, TellsACrash) {
  EXPECT_EQ(end_of([] { std::raise(SIGSEGV); }), Trial::End::crashed);
  EXPECT_EQ(end_of([] { ::_exit(1); }), Trial::End::crashed);
}

TEST(Trial, EndsWhatDoesNotComeToAnEnd) {
  EXPECT_EQ(end_of(
                [] {
                  for (;;) ::pause();
                },
                {.seconds = 1}),
            Trial::End::out_of_time);
}

#if !defined(__SANITIZE_ADDRESS__)  // which ends a process that wants too much
TEST(Trial, EndsWhatWantsTooMuchMemory) {
  // Volatile, or the compiler leaves the memory out.
  const auto take = [](std::size_t n) {
    volatile char* const taken = new char[n];
    taken[n - 1] = 1;
    delete[] taken;
  };
  const Trial::Limits limits{.seconds = 20, .memory = 64u << 20u};
  EXPECT_EQ(end_of([&] { take(std::size_t{32} << 20u); }, limits), Trial::End::done);
  EXPECT_EQ(end_of([&] { take(std::size_t{128} << 20u); }, limits), Trial::End::out_of_memory);
  take(std::size_t{128} << 20u);  // the limit is the trial's only
}
#endif

TEST(Trial, WhatWasNotBegunWasNotTried) { EXPECT_EQ(Trial({}).wait(), Trial::End::not_tried); }

}  // namespace
