#include "dem/laws/requirements.h"

#include "base/errors.h"

#include <cmath>
#include <sstream>

namespace dem
{
  void Requirements::operator()(const bool fulfilled, const char *entry, const double value, const char *rule) const
  {
    if (fulfilled && std::isfinite(value))
      return;
    std::ostringstream message;
    message << name << "/" << entry << " = " << value << ": " << rule;
    throw base::InputError(message.str());
  }

  void Requirements::strength(const char *entry, const double value) const
  {
    if (!(value >= 0))
      (*this)(false, entry, value, "must not be negative.");
  }
} // namespace dem
