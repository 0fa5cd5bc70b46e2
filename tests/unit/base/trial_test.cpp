#include "base/trial.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
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

// The lock of a killed run is free as soon as it is dead.
TEST(Trial, EndsWithTheProcessThatBeganIt) {
  const auto open_here = [] { return ::open(".", O_RDONLY | O_DIRECTORY | O_CLOEXEC); };
  const pid_t run = ::fork();
  if (run == 0) {
    const int lock = open_here();
    if (::flock(lock, LOCK_EX | LOCK_NB) != 0) ::_exit(1);
    Trial trial({.seconds = 20});
    trial.start([] { ::sleep(10); });
    ::usleep(100'000);
    ::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(run, &status, 0), run);
  ASSERT_TRUE(WIFSIGNALED(status)) << "it did not get the lock";
  const int lock = open_here();
  int tries = 0;  // of ten milliseconds
  while (::flock(lock, LOCK_EX | LOCK_NB) != 0 && tries < 100) {
    ::usleep(10'000);
    ++tries;
  }
  ::close(lock);
  EXPECT_LT(tries, 100) << "the copy holds it";
}

TEST(Trial, WhatWasNotBegunWasNotTried) { EXPECT_EQ(Trial({}).wait(), Trial::End::not_tried); }

}  // namespace
