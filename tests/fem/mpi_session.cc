// deal.II's distributed meshes need MPI, on one rank too: started and ended with the test run.
#include "base/mpi_alone.h"

#include <deal.II/base/mpi.h>

#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include <catch2/catch.hpp>

#include <memory>

namespace
{
  class MpiSession : public Catch::TestEventListenerBase
  {
  public:
    using TestEventListenerBase::TestEventListenerBase;

    void testRunStarting(const Catch::TestRunInfo &) override
    {
      static char          name[]  = "test_fem";
      static char         *words[] = {name, nullptr};
      int                  count   = 1;
      char               **argv    = words;
      const base::MpiAlone alone;
      session = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(count, argv, 1);
    }

    void testRunEnded(const Catch::TestRunStats &) override { session.reset(); }

  private:
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> session;
  };
}

CATCH_REGISTER_LISTENER(MpiSession)
