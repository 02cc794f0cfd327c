#include "apps/models/output.h"

namespace apps
{
} // namespace apps
