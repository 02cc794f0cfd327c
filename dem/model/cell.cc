#include "dem/model/cell.h"

#include "base/errors.h"
#include "dem/core/records.h"

#include <Eigen/LU>

#include <algorithm>
#include <sstream>

namespace dem
{
  Cell::Cell(const Eigen::Matrix3d &base, const int dimension)
    : dimensions(dimension)
    , H(base)
  {
    if (!base.allFinite() || !(base.determinant() > 0))
      throw base::InputError("periodic cell: its base vectors must be finite and span a volume above zero.");
    rate.assign(3 * record_size, 0.0);
    enter({0, 0, 0});
  }

  double Cell::volume() const { return H.determinant(); }

  void Cell::write_record(base::Column &column, const std::size_t record, const Eigen::Vector3d &value)
  {
    std::copy_n(value.data(), 3, &column[record_size * record]);
  }

  void Cell::set_gradient(const Eigen::Matrix3d &gradient)
  {
    if (!gradient.allFinite())
      throw base::InputError("periodic cell: the velocity gradient must be finite.");
    if (dimensions == 2 && !(gradient.row(2).isZero(0) && gradient.col(2).isZero(0)))
      throw base::InputError("periodic cell: in two dimensions the velocity gradient has no components along z.");
    G = gradient;
    for (int c = 0; c < 3; ++c)
      write_record(rate, c, G.col(c));
  }

  void Cell::advance(const double time_step)
  {
    const Eigen::Matrix3d before = H;
    const Eigen::Matrix3d growth = Eigen::Matrix3d::Identity() + time_step * G;
    if (!(growth.determinant() > 0))
      throw base::NumericalError("periodic cell: it turns inside out within one step. Lower the strain rate.");
    H         = growth * H;
    F         = growth * F;
    increment = time_step * G * growth.inverse();
    for (std::size_t i = 0; i < shifts.size(); ++i)
      {
        const Eigen::Vector3d k(shifts[i][0], shifts[i][1], shifts[i][2]);
        write_record(offset, i, H * k);
        write_record(motion, i, (H - before) * k);
      }
  }

  std::int32_t Cell::enter(const CellShift &shift)
  {
    const auto found = std::find(shifts.begin(), shifts.end(), shift);
    if (found != shifts.end())
      return static_cast<std::int32_t>(found - shifts.begin());
    shifts.push_back(shift);
    offset.resize(record_size * shifts.size(), 0.0);
    motion.resize(record_size * shifts.size(), 0.0);
    const Eigen::Vector3d k(shift[0], shift[1], shift[2]);
    write_record(offset, shifts.size() - 1, H * k);
    write_record(motion, shifts.size() - 1, increment * H * k);
    return static_cast<std::int32_t>(shifts.size() - 1);
  }

  Eigen::Vector3d Cell::offset_of(const std::int32_t image) const
  {
    return Eigen::Vector3d(&offset[record_size * static_cast<std::size_t>(image)]);
  }

  Eigen::Vector3d Cell::motion_of(const std::int32_t image) const
  {
    return Eigen::Vector3d(&motion[record_size * static_cast<std::size_t>(image)]);
  }

  std::size_t Cell::bytes() const
  {
    return (offset.capacity() + motion.capacity() + rate.capacity()) * sizeof(double) +
           shifts.capacity() * sizeof(CellShift);
  }

  void Cell::visit_state(base::StateVisitor &visitor)
  {
    base::Column matrices;
    for (const Eigen::Matrix3d *m : {&H, &F, &G, &increment})
      matrices.insert(matrices.end(), m->data(), m->data() + 9);
    std::vector<std::int32_t> flat;
    for (const CellShift &shift : shifts)
      flat.insert(flat.end(), shift.begin(), shift.end());
    visitor.column("cell/matrices", matrices);
    visitor.column("cell/shifts", flat);
    visitor.column("cell/offset", offset);
    visitor.column("cell/motion", motion);
    visitor.column("cell/rate", rate);

    int at = 0;
    for (Eigen::Matrix3d *m : {&H, &F, &G, &increment})
      *m = Eigen::Map<const Eigen::Matrix3d>(matrices.data() + 9 * at++);
    shifts.resize(flat.size() / 3);
    for (std::size_t i = 0; i < shifts.size(); ++i)
      for (int c = 0; c < 3; ++c)
        shifts[i][c] = static_cast<std::int8_t>(flat[3 * i + c]);
  }
} // namespace dem
