/* opponents_job.h - the job that all opponents do, behind plain C functions, so that C, C++ and Python can call
 * it.
 *
 * Dynamics `rigid`, the paper's parameters, omegas on [0.36, 1.20], 200 drive periods each from the
 * free-rolling start at r = 0.95: the job of bench_ensemble.
 */
#ifndef FST_BENCH_OPPONENTS_JOB_H
#define FST_BENCH_OPPONENTS_JOB_H

#ifdef __cplusplus
extern "C" {
#endif

#define JOB_API __attribute__((visibility("default")))
enum { JOB_STATE_SIZE = 10 };

/* A trajectory to be computed; its omega is the middle of part `index` of `count` equal parts of the range.
 * NULL if there is no memory. It is never freed: a job lasts as long as its program. */
typedef struct job_trajectory job_trajectory;
JOB_API const job_trajectory *job_trajectory_new(int index, int count);

JOB_API double job_omega(const job_trajectory *trajectory);
JOB_API double job_end_time(const job_trajectory *trajectory);
JOB_API void job_start(const job_trajectory *trajectory, double state[JOB_STATE_SIZE]);

/* The right-hand side that all of them integrate. */
JOB_API void job_rhs(const job_trajectory *trajectory, const double state[JOB_STATE_SIZE],
                     double derivative[JOB_STATE_SIZE]);

/* One trajectory by Boost.odeint's runge_kutta_fehlberg78 with its usual step control; 0 where it failed. */
int job_by_odeint(const job_trajectory *trajectory, double tolerance, double end[JOB_STATE_SIZE]);

#ifdef __cplusplus
}
#endif
#endif
