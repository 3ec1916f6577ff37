/* dry_siconos.c - the job of dry_peers.h by Moreau-Jean steps with Siconos' solver of the contact. */
#include "dry_peers.h"
#include "helpers/moreau_jean.h"

int dry_by_siconos(const dry_job *job, const dry_setting *setting, double *mean_r, double *periods)
{
    moreau_jean stepper;
    double end = 0.0;
    const double most = 4.0 * (DRY_DISCARD + DRY_TURNS) * job->drive_period;
    moreau_jean_begin(&stepper, job->model, job->mu, job->start, setting->step, setting->solver, 1e-12);
    stepper.early = setting->early;
    *mean_r = moreau_jean_mean_r(&stepper, DRY_DISCARD, DRY_TURNS, most, &end);
    *periods = end / job->drive_period;
    const int good = stepper.failures == 0 && isfinite(*mean_r);
    moreau_jean_end(&stepper);
    return good;
}
