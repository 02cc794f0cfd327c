// deal.II's distributed meshes need MPI, on one rank too: started and ended with the test run.
#include <deal.II/base/mpi.h>

#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include <catch2/catch.hpp>

#include <cstdlib>
#include <memory>

namespace
{
  class MpiSession : public Catch::TestEventListenerBase
  {
  public:
    using TestEventListenerBase::TestEventListenerBase;

    void testRunStarting(const Catch::TestRunInfo &) override
    {
      static char  name[]  = "test_fem";
      static char *words[] = {name, nullptr};
      int          count   = 1;
      char       **argv    = words;
      if (!std::getenv("OMPI_COMM_WORLD_SIZE"))
        ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0); // no daemon to launch others by
      session              = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(count, argv, 1);
    }

    void testRunEnded(const Catch::TestRunStats &) override { session.reset(); }

  private:
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> session;
  };
}

CATCH_REGISTER_LISTENER(MpiSession)
