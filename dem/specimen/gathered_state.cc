#include "dem/specimen/gathered_state.h"

#include "dem/model/column_memory.h"

#include <algorithm>
#include <stdexcept>

namespace dem
{
  namespace
  {
    bool is_of_state(LinkSet &links, const base::Column &column)
    {
      bool found = false;
      each_column_of_state(links, [&](const base::Column &each, std::size_t) { found = found || &each == &column; });
      return found;
    }
  } // namespace

  GatheredState::GatheredState(SpecimenCore &core_, base::StateVisitor &inner_)
    : core(core_)
    , inner(inner_)
  {
    core.gather_accounts();
    core.gather_glide();
  }

  void GatheredState::column(const std::string &name, base::Column &values)
  {
    SharedWork &shared = *core.shared;
    const auto  visit  = [&] { inner.column(name, values); };
    const auto  moving = records_of_motion(core.particles);
    if (is_of_state(core.bonds, values))
      shared.with_column_of_bonds(values, core.bonds, visit);
    else if (is_of_state(core.contacts, values))
      shared.with_column_of_contacts(values, core.contacts, visit);
    else if (std::find(moving.begin(), moving.end(), &values) != moving.end())
      shared.with_records(values, core.particles, visit);
    else
      {
        if (&values == &core.particles.pose)
          shared.gather_column(values);
        visit();
      }
  }

  void GatheredState::scalar(const std::string &name, std::int64_t &value)
  {
    const std::int64_t before = value;
    inner.scalar(name, value);
    if (value != before)
      throw std::logic_error("specimen: a state is taken up before the first step where ranks share its work");
  }
} // namespace dem
