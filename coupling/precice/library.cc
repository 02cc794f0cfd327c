#include "coupling/precice/library.h"

#include "base/errors.h"

#include <precice/precice.hpp>

namespace coupling
{
  namespace
  {
    /** What preCICE refuses is a mistake in its configuration, or that another participant is gone. */
    template <typename Call>
    auto in_our_words(const Call &call)
    {
      try
        {
          return call();
        }
      catch (const precice::Error &error)
        {
          throw base::InputError(std::string("preCICE: ") + error.what());
        }
    }

    class PreciceLibrary : public PreciceInterface
    {
    public:
      PreciceLibrary(const std::string &name, const std::string &configuration)
        : participant(in_our_words([&] { return std::make_unique<precice::Participant>(name, configuration, 0, 1); }))
      {
      }

      int mesh_dimensions(const std::string &mesh) const override
      {
        return in_our_words([&] { return participant->getMeshDimensions(mesh); });
      }

      std::vector<int> set_mesh_vertices(const std::string &mesh, const std::vector<double> &positions) override
      {
        std::vector<int> ids(positions.size() / static_cast<std::size_t>(mesh_dimensions(mesh)));
        in_our_words([&] { participant->setMeshVertices(mesh, positions, ids); });
        return ids;
      }

      bool requires_initial_data() override
      {
        return in_our_words([&] { return participant->requiresInitialData(); });
      }

      void initialize() override
      {
        in_our_words([&] { participant->initialize(); });
      }

      bool is_coupling_ongoing() const override
      {
        return in_our_words([&] { return participant->isCouplingOngoing(); });
      }

      double max_time_step_size() const override
      {
        return in_our_words([&] { return participant->getMaxTimeStepSize(); });
      }

      bool requires_writing_checkpoint() override
      {
        return in_our_words([&] { return participant->requiresWritingCheckpoint(); });
      }

      bool requires_reading_checkpoint() override
      {
        return in_our_words([&] { return participant->requiresReadingCheckpoint(); });
      }

      std::vector<double> read_data(const std::string      &mesh,
                                    const std::string      &data,
                                    const std::vector<int> &vertices,
                                    const double            relative_time) const override
      {
        std::vector<double> values(vertices.size() * static_cast<std::size_t>(mesh_dimensions(mesh)));
        in_our_words([&] { participant->readData(mesh, data, vertices, relative_time, values); });
        return values;
      }

      void write_data(const std::string         &mesh,
                      const std::string         &data,
                      const std::vector<int>    &vertices,
                      const std::vector<double> &values) override
      {
        in_our_words([&] { participant->writeData(mesh, data, vertices, values); });
      }

      void advance(const double time_step) override
      {
        in_our_words([&] { participant->advance(time_step); });
      }

      void finalize() override
      {
        in_our_words([&] { participant->finalize(); });
      }

    private:
      std::unique_ptr<precice::Participant> participant;
    };
  } // namespace

  JoinPrecice precice_library()
  {
    return [](const std::string &participant, const std::string &configuration) {
      return std::make_unique<PreciceLibrary>(participant, configuration);
    };
  }
} // namespace coupling
