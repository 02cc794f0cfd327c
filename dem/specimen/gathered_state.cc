#include "dem/specimen/gathered_state.h"

#include "dem/model/column_memory.h"

#include <algorithm>
#include <stdexcept>

namespace dem
{
  GatheredState::GatheredState(SpecimenCore &core_, base::StateVisitor &inner_)
    : core(core_)
    , inner(inner_)
  {
    core.gather_accounts();
    core.gather_glide();
  }

  void GatheredState::column(const std::string &name, base::Column &values)
  {
    SharedWork &shared   = *core.shared;
    const auto  records  = records_of_state(core.particles);
    const auto  in_parts = [&](const auto &tell) { inner.column_in_parts(name, values.size(), tell); };
    if (numbers_of_state(core.bonds, values) > 0)
      in_parts([&](const Take &take) { shared.tell_column_of_bonds(values, core.bonds, take); });
    else if (numbers_of_state(core.contacts, values) > 0)
      in_parts([&](const Take &take) { shared.tell_column_of_contacts(values, core.contacts, take); });
    else if (std::find(records.begin(), records.end(), &values) != records.end())
      in_parts([&](const Take &take) { shared.tell_records(values, take); });
    else if (&values == &core.search.places())
      in_parts([&](const Take &take) { shared.tell_places(core.search, take); });
    else
      inner.column(name, values);
  }

  void GatheredState::scalar(const std::string &name, std::int64_t &value)
  {
    const std::int64_t before = value;
    inner.scalar(name, value);
    if (value != before)
      throw std::logic_error("specimen: a state is taken up before the first step where ranks share its work");
  }
} // namespace dem
