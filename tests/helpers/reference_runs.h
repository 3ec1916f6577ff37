/* reference_runs.h - what the paper's bead does at seven drives, by an implementation that shares nothing with
 * this one.
 *
 * Made by a separate program (its own right-hand side written from the ten charges, steps of DOP853 with the
 * integrals as components of the state, sections and extremes found by repeated partial steps), checked against
 * SciPy's DOP853, at rtol = atol = 1e-11 over 400 drive periods, 200 of them discarded; the start is the
 * default one (r = 0.95, Phi = 3 degrees, rolling).  Repeated at 1e-12 over 800 periods, 600 discarded, the
 * means changed by less than 1e-11, save for farago2020 at omega = 0.2845, close to the period halving, where
 * the motion is still relaxing: means by 5e-9, extremes by 5e-7.  Numbers below 1e-11 are written as 0.
 */
#ifndef FST_TESTS_REFERENCE_RUNS_H
#define FST_TESTS_REFERENCE_RUNS_H

#include <festoon/festoon.h>

/* The numbers that the table holds. */
/* clang-format off */
#define REFERENCE_LIST(X)                                                                                      \
    X(mean_r) X(std_r) X(min_r) X(max_r) X(mean_alpha_dot) X(mean_phi_dot) X(mean_nz) X(festoons)              \
    X(max_angle_deg) X(mean_b) X(std_b) X(min_b) X(max_b) X(mean_friction_power) X(mean_drive_power)           \
    X(tilt_deg) X(mean_load_weights) X(min_load_weights) X(max_load_weights) X(period)                         \
    X(eq21_centrifugal) X(eq21_magnetic) X(eq21_magnetic_printed) X(eq21_friction) X(eq21_spin)                \
    X(eq22_magnetic) X(eq22_friction) X(mean_v_alpha) X(eq23_magnetic)
/* clang-format on */

enum { REFERENCE_RUNS = 7 };

/* clang-format off */
static const fst_run_result REFERENCE_FARAGO2020[REFERENCE_RUNS] = {
    {.omega = 0.21, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S1,
     .mean_r = 0.7418642988024, .std_r = 0.188769913404, .min_r = 0.3843961848196, .max_r =
     0.9389535264019, .mean_alpha_dot = -0.07004060686693, .mean_phi_dot = 0.2800406068669, .mean_nz =
     0.2838997488694, .festoons = 3.998260714659, .max_angle_deg = 4.204543298652, .mean_b =
     3.592425962727, .std_b = 0.4468450186335, .min_b = 2.920993827376, .max_b = 4.323012100013,
     .mean_friction_power = 0.0004082530982809, .mean_drive_power = 0.0004082530982809, .tilt_deg = 36.43136814231, .mean_load_weights = 22.90819274873, .min_load_weights
     = 15.35892573905, .max_load_weights = 32.87444649141, .period = 22.4366936548, .eq21_centrifugal =
     0.006538806668232, .eq21_magnetic = -0.007374504831208, .eq21_magnetic_printed = 0.01122515272605,
     .eq21_friction = 0.0008356981629756, .eq21_spin = -8.786638552482e-06, .eq22_magnetic =
     0.001967624318957, .eq22_friction = -0.001967624318957, .mean_v_alpha = 0.002253553628025,
     .eq23_magnetic = 0.002286531219007},
    {.omega = 0.25, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S1,
     .mean_r = 0.83362451423, .std_r = 0.1249731664299, .min_r = 0.5996098900179, .max_r =
     0.9577143745253, .mean_alpha_dot = -0.06180954239193, .mean_phi_dot = 0.3118095423919, .mean_nz =
     0.1633701958869, .festoons = 5.044682913437, .max_angle_deg = 4.164945610407, .mean_b =
     3.565246042824, .std_b = 0.5287529872305, .min_b = 2.760268592483, .max_b = 4.312967190409,
     .mean_friction_power = 0.0003440549313413, .mean_drive_power = 0.0003440549313412, .tilt_deg = 29.16044155608, .mean_load_weights = 23.28242816619, .min_load_weights
     = 14.21956053911, .max_load_weights = 32.82666582041, .period = 20.15071526991, .eq21_centrifugal =
     0.004784735580697, .eq21_magnetic = -0.008662498590194, .eq21_magnetic_printed = 0.0109597950967,
     .eq21_friction = 0.003877763009497, .eq21_spin = 0.003235402665151, .eq22_magnetic =
     0.001411165070923, .eq22_friction = -0.001411165070923, .mean_v_alpha = 0.001525390592251,
     .eq23_magnetic = 0.001521685060184},
    {.omega = 0.2845, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S1,
     .mean_r = 0.888624656943, .std_r = 0.05154604485574, .min_r = 0.7871621884846, .max_r =
     0.9452094797193, .mean_alpha_dot = -0.05629794849465, .mean_phi_dot = 0.3407979484917, .mean_nz =
     0.05290012285823, .festoons = 6.053470110497, .max_angle_deg = 3.68199422416, .mean_b =
     3.568041934816, .std_b = 0.5950902992709, .min_b = 2.667430673392, .max_b = 4.330266182574,
     .mean_friction_power = 0.0003409185853206, .mean_drive_power = 0.0003409185853821, .tilt_deg = 24.65366684673, .mean_load_weights = 23.83752701934, .min_load_weights
     = 13.57575097955, .max_load_weights = 32.7995430129, .period = 18.43668759851, .eq21_centrifugal =
     0.003518920316709, .eq21_magnetic = -0.009574971962251, .eq21_magnetic_printed = 0.01055015099943,
     .eq21_friction = 0.006056051640082, .eq21_spin = 0.005496700671457, .eq22_magnetic =
     0.001252564751916, .eq22_friction = -0.001252564751199, .mean_v_alpha = 0.0011089904753,
     .eq23_magnetic = 0.001062761556777},
    {.omega = 0.352, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S2,
     .mean_r = 0.9012117799999, .std_r = 0.01832660585959, .min_r = 0.8787838288331, .max_r =
     0.9295429390219, .mean_alpha_dot = -0.05889077938552, .mean_phi_dot = 0.4108907793855, .mean_nz = 0,
     .festoons = 13.95433321389, .max_angle_deg = 3.146803321065, .mean_b = 3.58529046448, .std_b =
     0.6000304105764, .min_b = 2.677016378394, .max_b = 4.333719170261, .mean_friction_power =
     0.0003646597068585, .mean_drive_power = 0.0003646597068584, .tilt_deg
     = 23.0704486418, .mean_load_weights = 24.17159997703, .min_load_weights = 13.64232384127,
     .max_load_weights = 32.63646753417, .period = 15.29161914165, .eq21_centrifugal = 0.003582325092524,
     .eq21_magnetic = -0.01009976009063, .eq21_magnetic_printed = 0.009605197807919, .eq21_friction =
     0.006517434998102, .eq21_spin = 0.005883262886656, .eq22_magnetic = 0.001113414268708,
     .eq22_friction = -0.001113414268709, .mean_v_alpha = 0.0009922954954101, .eq23_magnetic =
     0.0009899606641706},
    {.omega = 0.405, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S2,
     .mean_r = 0.9102513415736, .std_r = 0.01312106944054, .min_r = 0.8946867958659, .max_r =
     0.9309715163015, .mean_alpha_dot = -0.06240034995982, .mean_phi_dot = 0.4674003499598, .mean_nz = 0,
     .festoons = 14.98069643074, .max_angle_deg = 3.160750385501, .mean_b = 3.589587085536, .std_b =
     0.6013804962698, .min_b = 2.674398436209, .max_b = 4.333104005891, .mean_friction_power =
     0.0004004219773369, .mean_drive_power = 0.0004004219773375, .tilt_deg
     = 22.0952221958, .mean_load_weights = 24.30820567913, .min_load_weights = 13.62441056591,
     .max_load_weights = 32.72889908775, .period = 13.44283398102, .eq21_centrifugal = 0.003942946709139,
     .eq21_magnetic = -0.01064313268356, .eq21_magnetic_printed = 0.008460031893854, .eq21_friction =
     0.006700185974417, .eq21_spin = 0.00598884618352, .eq22_magnetic = 0.001084157295763, .eq22_friction
     = -0.001084157295765, .mean_v_alpha = 0.0009944954775849, .eq23_magnetic = 0.001044741292079},
    {.omega = 0.215, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S1,
     .mean_r = 0.7575835471069, .std_r = 0.1797119466211, .min_r = 0.4180247952486, .max_r =
     0.9442630244942, .mean_alpha_dot = -0.06864557251318, .mean_phi_dot = 0.2836455725132, .mean_nz =
     0.2649200831467, .festoons = 4.132030109571, .max_angle_deg = 4.207983150514, .mean_b =
     3.584725045102, .std_b = 0.458706401075, .min_b = 2.892900407141, .max_b = 4.320426366485,
     .mean_friction_power = 0.0003907545839825, .mean_drive_power = 0.0003907545839825, .tilt_deg = 35.22961120116, .mean_load_weights = 22.92592569614, .min_load_weights
     = 15.1588594776, .max_load_weights = 32.86888014177, .period = 22.15153669246, .eq21_centrifugal =
     0.006249579180209, .eq21_magnetic = -0.007646550274522, .eq21_magnetic_printed = 0.01111816225553,
     .eq21_friction = 0.001396971094313, .eq21_spin = 0.0005965029090644, .eq22_magnetic =
     0.001841871087064, .eq22_friction = -0.001841871087064, .mean_v_alpha = 0.002121473040531,
     .eq23_magnetic = 0.002152680615983},
    {.omega = 0.4, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S2,
     .mean_r = 0.9092732400242, .std_r = 0.0135150142333, .min_r = 0.8932067698746, .max_r =
     0.9305807107935, .mean_alpha_dot = -0.06205799623728, .mean_phi_dot = 0.4620579962373, .mean_nz = 0,
     .festoons = 14.89116710989, .max_angle_deg = 3.157395760617, .mean_b = 3.58943153466, .std_b =
     0.6011100441493, .min_b = 2.675105385703, .max_b = 4.333237788522, .mean_friction_power =
     0.0003961432240197, .mean_drive_power = 0.0003961432240203, .tilt_deg
     = 22.19120612678, .mean_load_weights = 24.29717666617, .min_load_weights = 13.62916407971,
     .max_load_weights = 32.72086104591, .period = 13.5982611671, .eq21_centrifugal = 0.003904946396055,
     .eq21_magnetic = -0.01058510249785, .eq21_magnetic_printed = 0.008580507909572, .eq21_friction =
     0.006680156101796, .eq21_spin = 0.005975888387326, .eq22_magnetic = 0.001084054464883,
     .eq22_friction = -0.001084054464884, .mean_v_alpha = 0.0009921587148487, .eq23_magnetic =
     0.001037409898603},
};

static const fst_run_result REFERENCE_RIGID[REFERENCE_RUNS] = {
    {.omega = 0.21, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S1,
     .mean_r = 0.7493414214658, .std_r = 0.1783942869417, .min_r = 0.4106968787365, .max_r =
     0.9322346072014, .mean_alpha_dot = -0.06904987786698, .mean_phi_dot = 0.279049877867, .mean_nz =
     0.2751906392932, .festoons = 4.041279818113, .max_angle_deg = 4.445839594375, .mean_b =
     3.588181445898, .std_b = 0.455259462035, .min_b = 2.898244901502, .max_b = 4.325530535192,
     .mean_friction_power = 0.0004081693932066, .mean_drive_power = 0.0004081693932065, .tilt_deg = 36.54603489444, .mean_load_weights = 22.90581986261, .min_load_weights
     = 15.1886873285, .max_load_weights = 32.86728665368, .period = 22.51635211313, .eq21_centrifugal =
     0.00626975416893, .eq21_magnetic = -0.007481392139903, .eq21_magnetic_printed = 0.01167322924396,
     .eq21_friction = 0.001211637970973, .eq21_spin = 0.0004148493874782, .eq22_magnetic =
     0.001943663777174, .eq22_friction = -0.001943663777174, .mean_v_alpha = 0.002169779607715,
     .eq23_magnetic = 0.002319503602241},
    {.omega = 0.25, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S1,
     .mean_r = 0.8476884480179, .std_r = 0.09728830742743, .min_r = 0.6598133193141, .max_r =
     0.9399518505641, .mean_alpha_dot = -0.06001855567605, .mean_phi_dot = 0.3100185556761, .mean_nz =
     0.1289425419728, .festoons = 5.165378476439, .max_angle_deg = 4.056932370647, .mean_b =
     3.56418848082, .std_b = 0.5527731538879, .min_b = 2.724984715999, .max_b = 4.325517350955,
     .mean_friction_power = 0.0003225556565213, .mean_drive_power = 0.0003225556565213, .tilt_deg = 28.91142423246, .mean_load_weights = 23.39998853399, .min_load_weights
     = 13.97049133479, .max_load_weights = 32.82609673441, .period = 20.26712657079, .eq21_centrifugal =
     0.004287482751291, .eq21_magnetic = -0.009008887714746, .eq21_magnetic_printed = 0.01185959291888,
     .eq21_friction = 0.004721404963455, .eq21_spin = 0.004188251330073, .eq22_magnetic =
     0.001290222626085, .eq22_friction = -0.001290222626085, .mean_v_alpha = 0.001273424641093,
     .eq23_magnetic = 0.001077539665521},
    {.omega = 0.2845, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S2,
     .mean_r = 0.8815370469023, .std_r = 0.02952051498839, .min_r = 0.8435420873578, .max_r =
     0.9257435337253, .mean_alpha_dot = -0.05706779855225, .mean_phi_dot = 0.3415677985523, .mean_nz =
     1.015828600335e-11, .festoons = 11.97059663129, .max_angle_deg = 2.903457923429, .mean_b =
     3.574358539809, .std_b = 0.5943464294243, .min_b = 2.683951572739, .max_b = 4.329031947559,
     .mean_friction_power = 0.0003049258289836, .mean_drive_power = 0.0003049258289832, .tilt_deg = 25.98245121651, .mean_load_weights = 23.84945523099, .min_load_weights
     = 13.69305432806, .max_load_weights = 32.31457171284, .period = 18.39513365666, .eq21_centrifugal =
     0.003437706025421, .eq21_magnetic = -0.009650588891053, .eq21_magnetic_printed = 0.01179570916312,
     .eq21_friction = 0.006212882865647, .eq21_spin = 0.005762414861362, .eq22_magnetic =
     0.001071795532454, .eq22_friction = -0.001071795532457, .mean_v_alpha = 0.0008993949258403,
     .eq23_magnetic = 0.0005727662682542},
    {.omega = 0.352, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S2,
     .mean_r = 0.88687385821, .std_r = 0.01811838202091, .min_r = 0.8644869636669, .max_r =
     0.9148250382638, .mean_alpha_dot = -0.06057137353924, .mean_phi_dot = 0.4125713735393, .mean_nz = 0,
     .festoons = 13.6226520692, .max_angle_deg = 2.937003568996, .mean_b = 3.593027540774, .std_b =
     0.5893882885793, .min_b = 2.70337362725, .max_b = 4.332787076063, .mean_friction_power =
     0.0003261957778256, .mean_drive_power = 0.0003261957778251, .tilt_deg
     = 24.9232688979, .mean_load_weights = 24.12372013299, .min_load_weights = 13.82073840669,
     .max_load_weights = 32.51041934801, .period = 15.22932929951, .eq21_centrifugal = 0.003690772449479,
     .eq21_magnetic = -0.009968912588642, .eq21_magnetic_printed = 0.01106715563142, .eq21_friction =
     0.006278140139162, .eq21_spin = 0.005789125874316, .eq22_magnetic = 0.0009266925506395,
     .eq22_friction = -0.0009266925506402, .mean_v_alpha = 0.0008195481121629, .eq23_magnetic =
     0.0005347361477853},
    {.omega = 0.405, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S2,
     .mean_r = 0.8962143544406, .std_r = 0.01297092354237, .min_r = 0.8806527270701, .max_r =
     0.9166669412054, .mean_alpha_dot = -0.06400440024416, .mean_phi_dot = 0.4690044002442, .mean_nz = 0,
     .festoons = 14.65537989435, .max_angle_deg = 3.150539675982, .mean_b = 3.597841616266, .std_b =
     0.5915026643707, .min_b = 2.700042380325, .max_b = 4.333738457229, .mean_friction_power =
     0.0003598014813962, .mean_drive_power = 0.0003598014813961, .tilt_deg
     = 23.92228854851, .mean_load_weights = 24.26892281627, .min_load_weights = 13.79899323967,
     .max_load_weights = 32.62324631286, .period = 13.39685790561, .eq21_centrifugal = 0.004045629612008,
     .eq21_magnetic = -0.01049226297214, .eq21_magnetic_printed = 0.009980080874091, .eq21_friction =
     0.006446633360132, .eq21_spin = 0.005936222990413, .eq22_magnetic = 0.0008883987194964,
     .eq22_friction = -0.0008883987194976, .mean_v_alpha = 0.0008089952093463, .eq23_magnetic =
     0.0005668653352786},
    {.omega = 0.215, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S1,
     .mean_r = 0.7660974628566, .std_r = 0.1677331137636, .min_r = 0.4476635389968, .max_r =
     0.9359716003735, .mean_alpha_dot = -0.06756697510152, .mean_phi_dot = 0.2825669751015, .mean_nz =
     0.2538761813064, .festoons = 4.182027901604, .max_angle_deg = 4.420026080527, .mean_b =
     3.580621525806, .std_b = 0.4689847916043, .min_b = 2.868102537573, .max_b = 4.32381827939,
     .mean_friction_power = 0.0003876675352594, .mean_drive_power = 0.0003876675352594, .tilt_deg = 35.28669473917, .mean_load_weights = 22.93582421287, .min_load_weights
     = 14.97537643676, .max_load_weights = 32.86400754951, .period = 22.23609218637, .eq21_centrifugal =
     0.005958606430846, .eq21_magnetic = -0.007783727766829, .eq21_magnetic_printed = 0.01163721755515,
     .eq21_friction = 0.001825121335983, .eq21_spin = 0.001079877570617, .eq22_magnetic =
     0.00180310481516, .eq22_friction = -0.00180310481516, .mean_v_alpha = 0.00201563969728,
     .eq23_magnetic = 0.002107227444602},
    {.omega = 0.4, .regime = FST_REGIME_COUNTER_ROTATING, .symmetry = FST_SYMMETRY_S2,
     .mean_r = 0.8951968582327, .std_r = 0.01336041689657, .min_r = 0.879123136815, .max_r =
     0.9162286031989, .mean_alpha_dot = -0.06366897641191, .mean_phi_dot = 0.4636689764119, .mean_nz = 0,
     .festoons = 14.56498918444, .max_angle_deg = 3.097235549704, .mean_b = 3.597639666, .std_b =
     0.5911560902498, .min_b = 2.700828645008, .max_b = 4.333725070646, .mean_friction_power =
     0.0003557666142417, .mean_drive_power = 0.0003557666142416, .tilt_deg
     = 24.02179830335, .mean_load_weights = 24.25701263794, .min_load_weights = 13.80412210238,
     .max_load_weights = 32.6133158529, .period = 13.55101511385, .eq21_centrifugal = 0.004008103609336,
     .eq21_magnetic = -0.0104356689426, .eq21_magnetic_printed = 0.01009667318528, .eq21_friction =
     0.006427565333264, .eq21_spin = 0.005918388125888, .eq22_magnetic = 0.000889416535604,
     .eq22_friction = -0.0008894165356051, .mean_v_alpha = 0.0008080548002866, .eq23_magnetic =
     0.0005620692181542},
};
/* clang-format on */

#endif
