#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dem
{
  /** What one rank sends to another, or receives from it. */
  struct RankMessage
  {
    std::size_t         rank = 0; ///< the other one
    std::vector<double> numbers;
  };

  /**
   * The processes ("ranks") among which the work of a specimen is shared out (doc/theory/ranks.md), as each of them sees it. All of them make the
   * same calls in the same order. dem knows no more of how they speak with each other.
   */
  class Ranks
  {
  public:
    virtual ~Ranks() = default;

    virtual std::size_t rank() const = 0; ///< this one, from 0
    virtual std::size_t size() const = 0;

    /** Of each number the largest that any rank has. */
    virtual void largest(double *numbers, std::size_t count) = 0;

    /** Each rank's part of an array, to all. @param begin of each rank's part and behind the last, in bytes */
    virtual void gather(void *array, const std::vector<std::size_t> &begin) = 0;

    /** Send to others, and receive from them what they send. @param received as long as what comes */
    virtual void exchange(const std::vector<RankMessage> &sent, std::vector<RankMessage> &received) = 0;

    /** The same for lists of which the others know nothing yet. @param lists one for each rank @return those of each rank for this one */
    virtual std::vector<std::vector<std::int32_t>> deliver(const std::vector<std::vector<std::int32_t>> &lists) = 0;

  protected:
    Ranks()                         = default;
    Ranks(const Ranks &)            = default;
    Ranks &operator=(const Ranks &) = default;
  };

  /** What a rank does of a specimen's work, at this moment, and what it has sent so far. */
  struct RankWork
  {
    std::int64_t particles     = 0; ///< that it moves
    std::int64_t links         = 0; ///< bonds and contacts that there are in its blocks
    std::int64_t copies        = 0; ///< of others that it updates as well
    std::int64_t wall_contacts = 0; ///< that it finds, and has
    std::int64_t ghosts        = 0; ///< particles of others that it needs
    std::int64_t neighbours    = 0; ///< ranks that it exchanges particles with
    std::int64_t messages      = 0; ///< of these exchanges, and gatherings
    std::int64_t bytes         = 0; ///< sent in both
  };
} // namespace dem
