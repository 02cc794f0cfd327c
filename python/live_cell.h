#pragma once

#include "coupling/multiscale/prepared_cell.h"
#include "dem/cells/responding_cell.h"

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace python
{
  /**
   * A periodic cell of particles as a material point: strain in, stress and tangent out, in the order xx yy zz yz zx xy with engineering
   * shears. Copies share what is the same of all, and know nothing of each other.
   */
  class LiveCell
  {
  public:
    /**
     * @param file packing with a periodic cell, of one material @param law of its links by name @param constants "Entry=value" each
     * @throws base::InputError
     */
    LiveCell(const std::string              &file,
             const std::string              &law,
             const std::vector<std::string> &constants,
             const coupling::CellParameters &parameters);
    LiveCell(const LiveCell &other);

    const coupling::PreparedCell &prepared() const { return shared->cell; }
    const dem::RespondingCell    &cell() const { return *own; }

    /** From the committed state; in the plane what leaves it is ignored. @throws base::InputError, base::NumericalError */
    dem::CellResponse respond(const base::Voigt &strain, bool with_tangent);
    void              commit() { own->commit(); }
    void              begin_step() { own->begin_step(); }

    /** All that is committed, as one row of numbers. */
    base::Column state() const;
    /** @throws base::InputError for a row of another cell */
    void set_state(const base::Column &row);

  private:
    struct Shared
    {
      coupling::PreparedCell cell;
      std::mutex             busy; ///< its linear system serves one cell after the other
    };

    std::shared_ptr<Shared>              shared;
    std::unique_ptr<dem::RespondingCell> own;
  };

  void bind_live_cell(pybind11::module_ &module);
} // namespace python
