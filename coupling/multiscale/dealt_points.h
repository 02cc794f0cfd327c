#pragma once

#include "base/column.h"
#include "base/state.h"

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace coupling
{
  /**
   * Points of a structure that every rank holds as a whole, dealt out like cards: each rank finds the answers of its own points and shows
   * them to the others. All ranks then sum up the same numbers in the same order, with the same bits for any number of ranks
   * (doc/theory/multiscale.md, 3).
   */
  class DealtPoints
  {
  public:
    /** @param communicator of the ranks that hold the structure; without MPI there is one */
    explicit DealtPoints(MPI_Comm communicator);

    /** Name the points, so that ranks which mix them up are caught. */
    void name(const std::string &group) { of_group = group; }

    bool alone() const { return ranks == 1; }
    /** @param number of the point in the whole mesh */
    bool has(const std::uint64_t number) const { return number % ranks == rank; }

    /**
     * To be called by all ranks. @param own numbers that this one shows, as many as it likes @return those of each rank
     * @throws std::logic_error where a rank shows points of another name
     */
    std::vector<base::Column> shown(const base::Column &own) const;

    /** Walks over what is shown of a point: written where it lives, read elsewhere. */
    using OfPoint = std::function<void(std::size_t point, base::StateVisitor &visitor)>;
    /** To be called by all ranks. @param own points of this one that have something to show */
    void share(const std::vector<std::size_t> &own, const OfPoint &visit) const;

  private:
    void require_one_group() const;

    MPI_Comm      communicator;
    std::string   of_group;
    std::uint64_t ranks = 1, rank = 0;
  };

  /** A text as a column of a state. */
  void visit_text(base::StateVisitor &visitor, const std::string &name, std::string &text);
} // namespace coupling
