/* A flow that one call of fst_flow_next() advances refuses another, from the same thread or from another: the
 * second is made while the first asks its progress, so that nothing is left to chance.  A library that looks at its
 * assertions ends there; a released one says so, and the first call is not disturbed.
 * tests: ode/advance.c
 * labels: threads memcheck */
#include "physics.h"

#include <pthread.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct visit {
    fst_flow *flow;
    fst_status status;
    fst_error error;
    int from_a_thread, visits;
} visit;

static void *intrude(void *user)
{
    visit *v = user;
    fst_stop stop;
    v->status = fst_flow_next(v->flow, 1.0, 0, &stop, &v->error);
    return NULL;
}

static fst_status tell(void *user, double fraction, const char *what, fst_error *error)
{
    (void)fraction, (void)what, (void)error;
    visit *v = user;
    pthread_t thread;
    if (v->visits++ > 0)
        return FST_OK;
    if (!v->from_a_thread)
        return intrude(v), FST_OK;
    assert_int_equal(pthread_create(&thread, NULL, intrude, v), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    return FST_OK;
}

/* The state at the end of 4000 units of time, with a visit to the flow or without one. */
static fst_flow_info advanced(visit *v)
{
    const fst_params p = bead_at(0.21, FST_DYNAMICS_RIGID);
    const fst_progress progress = {v, tell};
    fst_flow_options o = fst_default_flow_options();
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    fst_stop stop;
    fst_flow *flow;
    assert_int_equal(fst_start_state(&p, model, start, NULL), FST_OK);
    o.progress = v ? &progress : NULL;
    assert_int_equal(fst_flow_new(model, &o, start, &flow, NULL), FST_OK);
    if (v)
        v->flow = flow;
    assert_int_equal(fst_flow_next(flow, 4000.0, 0, &stop, NULL), FST_OK);
    const fst_flow_info info = fst_flow_get(flow);
    fst_flow_free(flow);
    fst_model_free(model);
    return info;
}

static void two_at_once_are_refused(void **state)
{
    (void)state;
#ifdef NDEBUG
    const fst_flow_info alone = advanced(NULL);
    for (int from_a_thread = 0; from_a_thread < 2; ++from_a_thread) {
        visit v = {.from_a_thread = from_a_thread};
        const fst_flow_info visited = advanced(&v);
        assert_true(v.visits > 0);
        assert_int_equal(v.status, FST_BAD_INPUT);
        assert_non_null(strstr(v.error.sentence, "one at a time"));
        assert_memory_equal(visited.state, alone.state, sizeof alone.state);
        assert_int_equal(visited.rhs_calls, alone.rhs_calls);
    }
#else
    int status;
    const pid_t child = fork();
    if (child == 0) {
        visit v = {.from_a_thread = 0};
        (void)signal(SIGABRT, SIG_DFL);
        (void)close(STDERR_FILENO);
        (void)advanced(&v);
        _exit(0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(two_at_once_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
