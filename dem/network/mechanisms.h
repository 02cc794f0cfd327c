#pragma once

#include "dem/network/stiffness_operator.h"

#include <string>
#include <vector>

namespace dem
{
  /** Linked particles that can move together without any link answering: the static solution leaves that motion undetermined. */
  struct Mechanism
  {
    std::vector<std::int32_t> particles; ///< numbers in the network, ascending
    std::size_t               links = 0; ///< of a single particle; of a group: that lead from it to other particles

    /**
     * Energy of the motion found, over the sum of what it would cost to move its particles one at a time. Rounding, for a
     * true mechanism; up to negligible_stiffness for one that is nearly so. 0 where there is no link at all.
     */
    double relative_stiffness = 0;
  };

  /** Relative stiffness below which a motion counts as a mechanism (doc/theory/statics.md, 3). */
  constexpr double negligible_stiffness = 1e-10;

  /** Lanes in which random fields stand beside the load cases. */
  constexpr int first_probe = 6;

  /** Fill the probe lanes with a reproducible random field in [-1/2, 1/2) length scales; held motions stay zero. */
  void fill_probes(const StiffnessOperator &stiffness, Fields &x);

  /**
   * Name the mechanisms. Conjugate gradients on K x = 0, begun with a random field, take out of it all that links resist;
   * what stays is a random mixture of all mechanisms, and each particle of each takes part in it.
   *
   * @param x          probe lanes as conjugate_gradients() left them
   * @param translates whether the network as a whole is free to translate, so that this is no mechanism (a periodic cell)
   */
  std::vector<Mechanism> find_mechanisms(const StiffnessOperator &stiffness, Fields x, bool translates);

  /** All particles of all mechanisms, ascending. */
  std::vector<std::int32_t> floaters(const std::vector<Mechanism> &mechanisms);

  /** One line that a user understands, at most `named` particles by number (from 1); empty if there is none. */
  std::string describe(const std::vector<Mechanism> &mechanisms, std::size_t named = 10);
} // namespace dem
