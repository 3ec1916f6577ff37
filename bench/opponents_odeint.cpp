// Boost.odeint's Runge-Kutta-Fehlberg of order 7(8), adaptive, with the job's right-hand side.
#include "opponents_job.h"

#include <array>
#include <exception>

#include <boost/numeric/odeint.hpp>

namespace odeint = boost::numeric::odeint;
using state_type = std::array<double, JOB_STATE_SIZE>;

int job_by_odeint(const job_trajectory *trajectory, double tolerance, double end[JOB_STATE_SIZE])
{
    const auto rhs = [trajectory](const state_type &y, state_type &dy, double) {
        job_rhs(trajectory, y.data(), dy.data());
    };
    state_type state;
    job_start(trajectory, state.data());
    try {
        const auto stepper =
            odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<state_type>());
        (void)odeint::integrate_adaptive(stepper, rhs, state, 0.0, job_end_time(trajectory), 1e-3);
    } catch (const std::exception &) {
        return 0;
    }
    std::copy(state.begin(), state.end(), end);
    return 1;
}
