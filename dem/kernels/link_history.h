#pragma once

#include "dem/core/simd.h"
#include "dem/kernels/link_law_of.h"
#include "dem/model/links.h"

#include <cstddef>

/** What the link pass reads and writes of the history of eight links. @tparam P see dem/kernels/link_policy.h */
namespace dem::link_update
{
  /** Where the columns of a law's history begin; looked up once per block. */
  template <typename P>
  struct HistoryColumns
  {
    using State = typename P::template State<Pack>;

    double *column[State::columns > 0 ? State::columns : 1];

    /** @param first of the set's columns that is the law's */
    HistoryColumns(LinkSet &links, const std::size_t first)
    {
      for (int c = 0; c < State::columns; ++c)
        column[c] = links.history[first + static_cast<std::size_t>(c)].data();
      if constexpr (P::Law::has_rows)
        rows = links.history.data() + first + State::columns;
    }

    base::Column        *rows = nullptr; ///< that the constants need, behind the columns
    static constexpr int shear_column(const int i) { return State::numbers + P::across * i; }
    static constexpr int bending_column(const int i) { return shear_column(State::shears) + P::across * i; }
    static constexpr int axis_column(const int i) { return bending_column(State::bendings) + P::across * i; }
  };

  template <typename P>
  BRECCIA_KERNEL void
  load_history(const HistoryColumns<P> &history, const std::size_t l, typename P::template State<Pack> &state)
  {
    using H = HistoryColumns<P>;
    using S = typename H::State;
    for (int i = 0; i < S::numbers; ++i)
      state.number[i] = load(history.column[i] + l);
    if constexpr (S::shears == 0)
      state.shear[0] = {}; // nobody's, but turned all the same
    for (int c = 0; c < P::across; ++c)
      {
        for (int i = 0; i < S::shears; ++i)
          state.shear[i][c] = load(history.column[H::shear_column(i) + c] + l);
        for (int i = 0; i < S::bendings; ++i)
          state.bending[i][c] = load(history.column[H::bending_column(i) + c] + l);
        for (int i = 0; i < S::axes; ++i)
          state.axis[i][c] = load(history.column[H::axis_column(i) + c] + l);
      }
  }

  /** Whether this is the one that lies still while the law says so. */
  template <typename P>
  constexpr bool is_resting_shear(const int i)
  {
    if constexpr (P::may_rest)
      return i == P::Law::resting_shear;
    else
      return false;
  }

  template <typename P>
  BRECCIA_KERNEL void store_history(const HistoryColumns<P>                &history,
                                    const std::size_t                       l,
                                    const typename P::template State<Pack> &before,
                                    const typename P::template State<Pack> &state,
                                    const bool                              rests)
  {
    using H                = HistoryColumns<P>;
    using S                = typename H::State;
    const unsigned changed = P::Law::changes_numbers(before, state);
    for (int i = 0; i < S::numbers; ++i)
      if (changed >> i & 1u)
        store(state.number[i], history.column[i] + l);
    for (int i = 0; i < S::shears; ++i)
      if (!rests || !is_resting_shear<P>(i))
        for (int c = 0; c < P::across; ++c)
          store(state.shear[i][c], history.column[H::shear_column(i) + c] + l);
    for (int i = 0; i < S::bendings; ++i)
      for (int c = 0; c < P::across; ++c)
        store(state.bending[i][c], history.column[H::bending_column(i) + c] + l);
    for (int i = 0; i < S::axes; ++i)
      for (int c = 0; c < P::across; ++c)
        store(state.axis[i][c], history.column[H::axis_column(i) + c] + l);
  }
} // namespace dem::link_update
