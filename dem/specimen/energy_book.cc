#include "dem/specimen/energy_book.h"

#include <string>

namespace dem
{
  void EnergyFlow::visit_state(base::StateVisitor &visitor, const char *name)
  {
    visitor.scalar(std::string(name) + "_before", before);
    visitor.scalar(std::string(name) + "_now", now);
    visitor.scalar(std::string(name) + "_after", after);
  }

  void EnergyBook::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("energy/initial", initial);
    visitor.scalar("energy/stored_at_start", stored_at_start);
    visitor.scalar("energy/weight_at_start", weight_at_start);
    work.visit_state(visitor, "energy/work");
    damped.visit_state(visitor, "energy/damped");
    visitor.scalar("energy/released", released);
  }
} // namespace dem
