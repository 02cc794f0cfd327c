#include "fem/output/snapshot.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/numerics/data_out.h>

#include <fstream>
#include <iomanip>
#include <sstream>

namespace fem
{
  using namespace dealii;

  namespace
  {
    /// Averages of point values at the vertices of a mesh.
    template <int dim>
    class VertexAverages
    {
    public:
      explicit VertexAverages(const Solid<dim> &solid)
        : dofs(*solid.mesh().triangulation)
      {
        if (solid.mesh().family == ElementFamily::hypercube)
          element = std::make_unique<FE_Q<dim>>(1);
        else
          element = std::make_unique<FE_SimplexP<dim>>(1);
        dofs.distribute_dofs(*element);
        DoFTools::extract_locally_relevant_dofs(dofs, relevant);
      }

      void add(const PointView<dim> &point, const Point<dim> &unit, const std::string &name, const double value)
      {
        auto &field = fields[name];
        if (field.first.size() == 0)
          {
            field.first.reinit(dofs.locally_owned_dofs(), relevant, dofs.get_communicator());
            field.second = field.first;
          }
        const typename DoFHandler<dim>::active_cell_iterator cell(&dofs.get_triangulation(), point.cell->level(),
                                                                  point.cell->index(), &dofs);
        indices.resize(element->n_dofs_per_cell());
        cell->get_dof_indices(indices);
        for (unsigned int i = 0; i < indices.size(); ++i)
          {
            const double share = point.volume * element->shape_value(i, unit);
            field.first[indices[i]] += share * value;
            field.second[indices[i]] += share;
          }
      }

      /// Completes the averages, the same names on all ranks, and shows them.
      template <typename Show>
      void finish(const Show &show)
      {
        std::vector<std::string> names;
        for (const auto &field : fields)
          names.push_back(field.first);
        std::map<std::string, int> all;
        for (const auto &of_rank : Utilities::MPI::all_gather(dofs.get_communicator(), names))
          for (const auto &name : of_rank)
            all[name] = 1;
        for (const auto &entry : all)
          {
            auto &[sum, weight] = fields[entry.first];
            if (sum.size() == 0)
              {
                sum.reinit(dofs.locally_owned_dofs(), relevant, dofs.get_communicator());
                weight = sum;
              }
            sum.compress(VectorOperation::add);
            weight.compress(VectorOperation::add);
            for (unsigned int i = 0; i < sum.locally_owned_size(); ++i)
              if (weight.local_element(i) > 0)
                sum.local_element(i) /= weight.local_element(i);
            sum.update_ghost_values();
            show(dofs, entry.first, sum);
          }
      }

    private:
      std::unique_ptr<FiniteElement<dim>>              element;
      DoFHandler<dim>                                  dofs;
      IndexSet                                         relevant;
      std::map<std::string, std::pair<Vector, Vector>> fields; // sum, weight
      std::vector<types::global_dof_index>             indices;
    };

    /// Largest value of the points of every element, for histories of one number.
    template <int dim>
    class ElementMaxima
    {
    public:
      explicit ElementMaxima(const Triangulation<dim> &mesh)
        : n_cells(mesh.n_active_cells())
        , communicator(mesh.get_communicator())
      {
      }

      void add(const unsigned int cell, const std::string &name, const double value)
      {
        auto &field = fields[name];
        if (field.size() == 0)
          field.reinit(n_cells);
        field[cell] = std::max(field[cell], value);
      }

      /// Hands the fields over, the same names on all ranks; they must live until the file is written.
      void show(DataOut<dim> &out)
      {
        std::vector<std::string> names;
        for (const auto &field : fields)
          names.push_back(field.first);
        for (const auto &of_rank : Utilities::MPI::all_gather(communicator, names))
          for (const auto &name : of_rank)
            if (fields[name].size() == 0)
              fields[name].reinit(n_cells);
        for (const auto &[name, values] : fields)
          out.add_data_vector(values, name + "_of_element", DataOut<dim>::type_cell_data);
      }

    private:
      unsigned int                                  n_cells;
      MPI_Comm                                      communicator;
      std::map<std::string, dealii::Vector<double>> fields;
    };

    std::string component_name(const std::string &name, const int component, const int count)
    {
      if (count == 1)
        return name;
      return name + "_" + (count == 6 ? voigt_names[component] : std::to_string(component));
    }

    /// Field names without blanks and units, as ParaView's expressions need them.
    std::string plain(std::string name)
    {
      name = name.substr(0, name.find(" ["));
      for (char &c : name)
        if (c == ' ' || c == '-')
          c = '_';
      return name;
    }

    /// @return whether all of it is in the file
    bool write_whole(const std::string &file, const std::string &text)
    {
      std::ofstream stream(file);
      stream << text;
      stream.close();
      return !stream.fail();
    }

    /// The file that names the pieces of all ranks, without the date that the library puts into it: equal states, equal files.
    template <int dim, typename Piece>
    std::string record_of(const DataOut<dim> &out, const unsigned int ranks, const Piece &piece)
    {
      std::vector<std::string> pieces;
      for (unsigned int rank = 0; rank < ranks; ++rank)
        pieces.push_back(piece(rank));
      std::ostringstream stream;
      out.write_pvtu_record(stream, pieces);
      std::string text = stream.str();
      if (const auto date = text.find(" on 2"); date != std::string::npos)
        text.erase(date, text.find('\n', date) - date);
      return text;
    }
  }

  template <int dim>
  std::string write_snapshot(Solid<dim>        &solid,
                             const Vector      &displacement,
                             const Vector      &reaction,
                             const std::string &folder,
                             const std::string &name,
                             const unsigned int number)
  {
    DataOut<dim>                                                                out;
    const std::vector<DataComponentInterpretation::DataComponentInterpretation> vector(
      dim, DataComponentInterpretation::component_is_part_of_vector);
    out.add_data_vector(solid.dofs(), displacement, std::vector<std::string>(dim, "displacement"), vector);
    out.add_data_vector(solid.dofs(), reaction, std::vector<std::string>(dim, "reaction"), vector);

    VertexAverages<dim> averages(solid);
    ElementMaxima<dim>  maxima(*solid.mesh().triangulation);
    unsigned int        q = 0;
    solid.visit_points(displacement, [&](const PointView<dim> &point) {
      const Point<dim> unit = solid.quadrature().point(q);
      q                     = (q + 1) % solid.quadrature().size();
      for (int i = 0; i < 6; ++i)
        {
          averages.add(point, unit, std::string("stress_") + voigt_names[i], point.stress[i]);
          averages.add(point, unit, std::string("strain_") + voigt_names[i], point.strain[i]);
        }
      point.material->visit(point.index, [&](const char *column, const double *values, const int count) {
        if (std::string(column).compare(0, 4, "old ") != 0) // the strain and stress above
          {
            for (int i = 0; i < count; ++i)
              averages.add(point, unit, component_name(plain(column), i, count), values[i]);
            if (count == 1)
              maxima.add(point.cell->active_cell_index(), plain(column), *values);
          }
      });
    });
    averages.finish([&](const DoFHandler<dim> &dofs, const std::string &field, const Vector &values) {
      out.add_data_vector(dofs, values, field);
    });

    maxima.show(out);

    const unsigned int degree = solid.options().degree;
    out.build_patches(solid.mapping(), degree);
    DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false;                             // equal states, equal files
    flags.compression_level   = DataOutBase::VtkFlags::best_speed; // the best one took half the time of explicit runs
    out.set_flags(flags);
    const MPI_Comm     comm  = solid.communicator();
    const unsigned int ranks = Utilities::MPI::n_mpi_processes(comm), rank = Utilities::MPI::this_mpi_process(comm);
    std::ostringstream stem;
    stem << name << "_" << std::setw(6) << std::setfill('0') << number;
    const auto piece = [&](const unsigned int of) {
      return stem.str() + (ranks > 1 ? "." + std::to_string(of) : "") + ".vtu";
    };
    std::ostringstream text;
    out.write_vtu(text);
    bool good = write_whole(folder + "/" + piece(rank), text.str());
    if (ranks > 1 && rank == 0)
      good = write_whole(folder + "/" + stem.str() + ".pvtu", record_of(out, ranks, piece)) && good;
    if (Utilities::MPI::min(good ? 1 : 0, comm) == 0)
      throw std::runtime_error(folder + "/" + piece(rank) + ": cannot be written. Check space and permissions.");
    return ranks > 1 ? stem.str() + ".pvtu" : piece(0);
  }

  template std::string
  write_snapshot(Solid<2> &, const Vector &, const Vector &, const std::string &, const std::string &, unsigned int);
  template std::string
  write_snapshot(Solid<3> &, const Vector &, const Vector &, const std::string &, const std::string &, unsigned int);
}
