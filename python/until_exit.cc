#include "python/until_exit.h"

#include "apps/process/mpi_session.h"

#include <algorithm>
#include <set>
#include <vector>

namespace python
{
  namespace
  {
    std::set<UntilExit *> &all()
    {
      static auto *const living = new std::set<UntilExit *>; // some go after the library's own objects
      return *living;
    }

    std::vector<std::weak_ptr<apps::RunResult>> &results()
    {
      static std::vector<std::weak_ptr<apps::RunResult>> found;
      return found;
    }
  } // namespace

  UntilExit::UntilExit() { all().insert(this); }
  UntilExit::~UntilExit() { all().erase(this); }

  void keep_until_exit(const std::shared_ptr<apps::RunResult> &result)
  {
    std::vector<std::weak_ptr<apps::RunResult>> &kept = results();
    kept.erase(std::remove_if(kept.begin(), kept.end(), [](const auto &one) { return one.expired(); }), kept.end());
    kept.push_back(result);
  }

  void leave()
  {
    for (UntilExit *one : all())
      one->let_go();
    for (const auto &one : results())
      if (const auto result = one.lock())
        result->specimen.reset();
    apps::finish_mpi();
  }
} // namespace python
