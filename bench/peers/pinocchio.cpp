// bench/peers/pinocchio.cpp - Pinocchio on the same model and states, one node at a time.
//
//   pinocchio FOLDER        with model.txt and states.bin of `ours write`
//
// Header-only: its own library would be built for another processor. Joints along an axis use
// its specialised types. The vector-Jacobian product is made of the full derivatives, since
// there is no reverse sweep.
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody.hpp>

#include <string>

#include "timing.h"

namespace pin = pinocchio;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

static pin::Model model;
static pin::Data *data;
static Vector q[peer_states], qd[peer_states], qdd[peer_states], weights[peer_states];
static Vector gradient[3];
static Matrix jacobian[3];

static pin::JointModel joint_of(const peer_row &row) {
  Eigen::Vector3d axis(row.axis);
  if (row.axis[0] == 1)
    return row.prismatic ? pin::JointModel(pin::JointModelPX()) : pin::JointModelRX();
  if (row.axis[1] == 1)
    return row.prismatic ? pin::JointModel(pin::JointModelPY()) : pin::JointModelRY();
  if (row.axis[2] == 1)
    return row.prismatic ? pin::JointModel(pin::JointModelPZ()) : pin::JointModelRZ();
  if (row.prismatic) return pin::JointModelPrismaticUnaligned(axis);
  return pin::JointModelRevoluteUnaligned(axis);
}

static void read(FILE *file, double *values, int count) {
  for (int i = 0; i < count; i++)
    if (fscanf(file, "%lf", &values[i]) != 1) exit(1);
}

static void read_model(const std::string &path) {
  FILE *file = fopen(path.c_str(), "r");
  int d = 0;
  if (!file || fscanf(file, "%d", &d) != 1) exit(1);
  double gravity[3];
  read(file, gravity, 3);
  model.gravity.linear() = Eigen::Vector3d(gravity);
  for (int i = 0; i < d; i++) {
    peer_row row;
    if (fscanf(file, "%d %d", &row.parent, &row.prismatic) != 2) exit(1);
    read(file, row.axis, 3);
    read(file, row.place, 3);
    read(file, &row.mass, 1);
    read(file, row.com, 3);
    read(file, row.inertia, 6);
    pin::SE3 place(Eigen::Matrix3d::Identity(), Eigen::Vector3d(row.place));
    pin::JointIndex joint = model.addJoint(static_cast<pin::JointIndex>(row.parent + 1),
                                           joint_of(row), place, "joint" + std::to_string(i));
    if (row.mass == 0) continue;
    const double *v = row.inertia;
    Eigen::Matrix3d inertia;
    inertia << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
    model.appendBodyToJoint(joint, pin::Inertia(row.mass, Eigen::Vector3d(row.com), inertia),
                            pin::SE3::Identity());
  }
  fclose(file);
}

static void run_tau(int s) {
  pin::rnea(model, *data, q[s], qd[s], qdd[s]);
}
static void run_jacobians(int s) {
  pin::computeRNEADerivatives(model, *data, q[s], qd[s], qdd[s], jacobian[0], jacobian[1],
                              jacobian[2]);
}
static void run_vjp(int s) {
  run_jacobians(s);
  gradient[0].noalias() = jacobian[0].transpose() * weights[s];
  gradient[1].noalias() = jacobian[1].transpose() * weights[s];
  // only the upper half of the mass matrix is filled
  gradient[2].noalias() = jacobian[2].selfadjointView<Eigen::Upper>() * weights[s];
}

int main(int argc, char **argv) {
  if (argc < 2) return 1;
  std::string folder(argv[1]);
  read_model(folder + "/model.txt");
  pin::Data its_data(model);
  data = &its_data;
  int d = model.nv;
  double *states = peer_read_states((folder + "/states.bin").c_str(), d);
  for (int k = 0; k < 3; k++) {
    jacobian[k] = Matrix::Zero(d, d);
    gradient[k] = Vector::Zero(d);
  }
  for (int s = 0; s < peer_states; s++) {
    const double *at = states + static_cast<size_t>(s) * peer_record(d);
    Vector *const parts[] = {&q[s], &qd[s], &qdd[s], &weights[s]};
    for (int k = 0; k < 4; k++) *parts[k] = Eigen::Map<const Vector>(at + k * d, d);
    run_vjp(s);
    for (int k = 0; k < 3; k++) {
      peer_expect("Pinocchio's gradient", peer_difference(gradient[k].data(), at + (5 + k) * d, d));
      Matrix full = k == 2 ? Matrix(jacobian[2].selfadjointView<Eigen::Upper>()) : jacobian[k];
      Matrix by_rows = full.transpose();
      peer_expect("Pinocchio's Jacobian",
                  peer_difference(by_rows.data(), at + 8 * d + k * d * d, d * d));
    }
    run_tau(s);
    peer_expect("Pinocchio's tau", peer_difference(data->tau.data(), at + 4 * d, d));
  }
  peer_time("pinocchio", "tau", run_tau, peer_states, 1);
  peer_time("pinocchio", "tau+vjp", run_vjp, peer_states, 1);
  peer_time("pinocchio", "jacobians", run_jacobians, peer_states, 1);
  free(states);
  return 0;
}
