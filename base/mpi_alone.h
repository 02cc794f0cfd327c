#pragma once

#include <array>
#include <cstdlib>
#include <utility>
#include <vector>

namespace base
{
  /**
   * For the start of MPI in a process that nobody has launched: Open MPI then starts no daemon that could launch others, and does not wait for
   * networks that nobody else is on. What the environment says of it already stays, and afterwards it is as it was: programs that this one
   * starts may be launched.
   */
  class MpiAlone
  {
  public:
    MpiAlone()
    {
      for (const char *const sign : {"OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMIX_NAMESPACE"})
        if (std::getenv(sign))
          return;
      constexpr std::array<std::pair<const char *, const char *>, 3> settings = {
        {{"OMPI_MCA_ess_singleton_isolated", "1"}, {"OMPI_MCA_pml", "ob1"}, {"OMPI_MCA_btl", "self"}}};
      for (const auto &[variable, value] : settings)
        if (!std::getenv(variable) && ::setenv(variable, value, 0) == 0)
          set.push_back(variable);
    }
    ~MpiAlone()
    {
      for (const char *const variable : set)
        ::unsetenv(variable);
    }
    MpiAlone(const MpiAlone &)            = delete;
    MpiAlone &operator=(const MpiAlone &) = delete;

  private:
    std::vector<const char *> set;
  };
} // namespace base
