#pragma once

#include "base/state.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace coupling
{
  /** A cell that has localised. */
  struct Localisation
  {
    Eigen::Vector3d place = {0, 0, 0}, normal = {0, 0, 0}; ///< [m], unit
    std::int64_t    state = 0;                             ///< in which

    std::string text() const;
  };

  /** Those of a structure, in the order in which they were found, and whether the run ends with them. */
  class Localisations
  {
  public:
    /** @param end why no state after this is worth anything; "": they are */
    void add(const Localisation &localisation, const std::string &end);

    const std::vector<Localisation> &all() const { return found; }
    std::vector<std::string>         notes() const;
    const std::string               &end_of_validity() const { return end; }

    void visit_state(base::StateVisitor &visitor);

  private:
    std::vector<Localisation> found;
    std::string               end;
  };
} // namespace coupling
