#pragma once

#include "dem/ranks/ranks.h"

#include <condition_variable>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

/** Ranks as threads of one process, for tests: what they send each other lies in their common memory. */
namespace rank_threads
{
  /** Another rank has thrown, and will not come. */
  struct LeftAlone : std::runtime_error
  {
    LeftAlone()
      : std::runtime_error("another rank has ended")
    {
    }
  };

  class Team
  {
  public:
    explicit Team(const std::size_t size)
      : shown(size, nullptr)
    {
    }

    /** Show something to the others, let each visit what all show, and go on when all have. */
    template <typename Visit>
    void meet(const std::size_t rank, const void *thing, const Visit &visit)
    {
      shown[rank] = thing;
      wait();
      visit(shown);
      wait();
    }
    void give_up()
    {
      const std::lock_guard<std::mutex> lock(mutex);
      ended = true;
      changed.notify_all();
    }

  private:
    void wait()
    {
      std::unique_lock<std::mutex> lock(mutex);
      const std::size_t            now = meeting;
      if (++waiting == shown.size())
        {
          waiting = 0;
          ++meeting;
          changed.notify_all();
          return;
        }
      changed.wait(lock, [&] { return meeting != now || ended; });
      if (meeting == now)
        throw LeftAlone();
    }

    std::vector<const void *> shown;
    std::mutex                mutex;
    std::condition_variable   changed;
    std::size_t               waiting = 0, meeting = 0;
    bool                      ended = false;
  };

  class RankThread : public dem::Ranks
  {
  public:
    RankThread(Team &all, const std::size_t number, const std::size_t count)
      : team(all)
      , self(number)
      , all_of(count)
    {
    }
    std::size_t rank() const override { return self; }
    std::size_t size() const override { return all_of; }

    void largest(double *numbers, const std::size_t count) override
    {
      const std::vector<double> own(numbers, numbers + count);
      team.meet(self, own.data(), [&](const std::vector<const void *> &shown) {
        for (const void *other : shown)
          for (std::size_t i = 0; i < count; ++i)
            numbers[i] = std::max(numbers[i], static_cast<const double *>(other)[i]);
      });
    }
    void gather(void *array, const std::vector<std::size_t> &begin) override
    {
      team.meet(self, array, [&](const std::vector<const void *> &shown) {
        for (std::size_t r = 0; r < all_of; ++r)
          if (r != self && begin[r + 1] > begin[r])
            std::memcpy(static_cast<char *>(array) + begin[r], static_cast<const char *>(shown[r]) + begin[r],
                        begin[r + 1] - begin[r]);
      });
    }
    void exchange(const std::vector<dem::RankMessage> &sent, std::vector<dem::RankMessage> &received) override
    {
      team.meet(self, &sent, [&](const std::vector<const void *> &shown) {
        for (dem::RankMessage &message : received)
          for (const auto &other : *static_cast<const std::vector<dem::RankMessage> *>(shown[message.rank]))
            if (other.rank == self)
              {
                if (other.numbers.size() != message.numbers.size())
                  throw std::logic_error("a message of another length than its receiver expects");
                message.numbers = other.numbers;
              }
      });
    }
    std::vector<std::vector<std::int32_t>> deliver(const std::vector<std::vector<std::int32_t>> &lists) override
    {
      std::vector<std::vector<std::int32_t>> received;
      team.meet(self, &lists, [&](const std::vector<const void *> &shown) {
        for (const void *other : shown)
          received.push_back((*static_cast<const std::vector<std::vector<std::int32_t>> *>(other))[self]);
      });
      return received;
    }

  private:
    Team       &team;
    std::size_t self, all_of;
  };

  /** Do something on so many ranks. @throws what the first of them that threw has thrown */
  inline void run(const std::size_t count, const std::function<void(std::shared_ptr<dem::Ranks>)> &work)
  {
    Team                            team(count);
    std::vector<std::thread>        threads;
    std::vector<std::exception_ptr> errors(count);
    for (std::size_t r = 0; r < count; ++r)
      threads.emplace_back([&, r] {
        try
          {
            work(std::make_shared<RankThread>(team, r, count));
          }
        catch (...)
          {
            errors[r] = std::current_exception();
            team.give_up();
          }
      });
    for (std::thread &thread : threads)
      thread.join();
    std::exception_ptr alone;
    for (const std::exception_ptr &error : errors)
      if (error)
        try
          {
            std::rethrow_exception(error);
          }
        catch (const LeftAlone &)
          {
            alone = error;
          }
    if (alone)
      std::rethrow_exception(alone);
  }
} // namespace rank_threads
