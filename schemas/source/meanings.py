"""What names in documents mean wherever they are, for those that do not say it in their own place."""

_TEXT = """
adjustments: Between as found and as left | change: Of the value | chord_um: That the path is drawn within
cycle_time_s: Of the whole program | date_from: Where the date was taken from | days: Between the two
drifts: Between as left and as found | group: Which kind of result it is of | half_width_95_per_day: Of the slope's 95 % interval
mean_moving_range: Of neighbouring results | moving_range: Difference from the result before | page_bytes: Size of the page
per_day: Slope of the line | residual_sd: About the line | significant: Zero is not in the slope's interval
state: as-found or as-left | state_from: Where the state was taken from | time_s: Into the program
tolerance: Limit of the last result | tools: By their numbers | triangles: Of the mesh | type: Shape of the cutter
upper_moving_range: Limit of moving ranges
X: Of this axis | Y: Of this axis | Z: Of this axis | accept: Share that is accepted | acceptance_limit: Where the rule accepts
actual: With the errors | after: With the compensated program | alias_of: ISO 230-1 name of the symbol
allocation: Tolerances that would do | amplitude_um: Amplitude | angles_deg: Where it was read | at_deg: Where
axis: Letter of the axis | axis_order: Order of rows and columns | axis_urad: Difference of the tool axes
ball: Spindle ball off | ball_diameter_mm: Of the probe | before: With the program as it was | best: Of the best machine
best_of_size: The best set of each size | birge: Birge ratio | bits: Information | bits_per_hour: Information by effort
blank_mm3: Volume of the blank | blank_volume_mm3: Volume of the blank | block: Path segment | blocks: Number of blocks
both_sides: The limit holds for either sign | bound: It is at most | bound_um: Of its approximation | box: Box plot of the values
breakpoints_s_m_s2: Time and acceleration | breakpoints_s_rad_s2: Time and acceleration | budget_hours: Of --hours
cancel_in_part: Errors that cancel in part | cancelled: Characteristics in which it cancels | capture_deg: First and last angle
ccw_angles_deg: Of the ccw run | cw_angles_deg: Of the cw run | center: Of the circle | center_mm: Of the circle
centre_bi: Of both runs, um | change_percent: From the first machine to the second | characteristic: Its name
characteristic_units: Units of the rows | characteristics: Names, or results of each | chi2: Chi square | ci95: 95 % confidence interval
circle: Of --circle | cmm: The machine that measured | cmm_hours: At the CMM | column: The first is 1 | columns: Of the map or of the rows
commands: Commands within | commitment_holds: The answers are those that were promised | compare: Beside another machine
compliance_um_per_n: Its height | condition: Condition number | cone_angle_deg: Half apex angle | conform: Share within the limit
conform_at_bound: Least and most, with the bound of the engine | consistent: The readings fit the model | constant: In every direction
consumer: Risk that a bad part is accepted | contacts: Points that hold the zone | contribution_share: Share of the width
controls: Draws that were also cut and measured in full | cost: Of these tolerances | count: How many
coverage_95: Share within the 95 % interval | criterion: As asked for | crps: Continuous ranked probability score, um
damped: Modes with damping | damping_ratio: Of each mode | date: Of the measurement | degrees: Degrees of freedom
degrees_of_freedom: Of the fit | depth_mm: Into the stock | description: In words | deviation_um: Of the surface
deviations_down_um: A row a target | diagnostics: What was found | dialect: Of the program | difference: On the machine less on the CMM
differing: Files that the key makes otherwise | direction: Its direction | direction_off_urad: From nominal
directions: Independent directions of errors that show | dominant_peaks: The highest peaks of the responses | draw: Its number
draws: Number of draws | draws_computed: Now, not before | element: As asked for | end_points: From the line through its ends, um
ended_unix_s: Time at the end | engine: How it was computed | equation: Of the source | error: Name, or number of errors
error_um: Deviation of the indication | errors: Names, or each with its values | estimates: Of every unknown | excess: Most material left
expected_rms_um: Of the noise | factor: On the stated value | factors: On the tolerances, by group | failed: Draws without a part
failed_on_sphere: In the probing test | failed_seeds: That failed | feature: Of the plan | feed_deg_min: As programmed
feed_mm_min: As programmed | feed_mode: What the feed counts | file: Where | findings: What was found | finished_mm3: Of the finished part
first: First-order index | first_file: Of the first program | first_line: Of the first program | first_se: Its standard error
first_um_per_gn: Of this machine | form_um: Peak to valley without the first harmonic | formula: In words
frequency_hz: Of each | frequency_range_hz: Lowest and highest of each mode | from_previous_mm: From the axis before it
from_um: Lower end | g54_in_table_mm: Origin of the program | gain: Largest effect | gain_unit: Of the gain
gains: Of every error, on the CMM and on the machine | gouge: Deepest cut into the nominal | gravity_sag_um: Of the tip
groups: Of errors | grow: Errors that show more on the machine | growth: Of the effect beyond first order | height_um: Just after the reversal
help: In words | highest_hz: Of all modes | highest_um: Deviation | hint: What to do | histogram: Of the deviations
hold: Where the bar's direction is held | holds: All of it | host: Name of the computer | hours: Machine and CMM together | id: Its id
identified: What was found | identifies_all: No error is left open | identifying_sets: Number of sets of this size that identify all
imbalance: Of the multipliers | inclination_deg: Of the cone's axis | index: Of the draw | interval_95: Of the factor
interval_score_95: Of the 95 % interval | jerk_move: Of --move | joint: Of all characteristics together
kept: Characteristics in which it stays | kind: Its kind | kinetic_share: Of the kinetic energy
largest_after_the_move_um: Deviation after the move | largest_at: Which reading | largest_axis_urad: Difference of tool axes
largest_difference: From the machine's own errors | largest_difference_um: From analytic samples | largest_reading_um: Of the bar
largest_sd_um: Its standard deviation | largest_time_ratio: Of the times of a block | largest_tip_um: Difference of tips
largest_um: Largest of them | last_line: Where it ends | least_squares: From the least-squares line, um | length: Bar longer by
length_mm: Length | limit: Largest that conforms | limit_um: Of the indication | line: Of the program | lobe: Amplitude
lobe_phase_deg: Of the lobes | log_det: Of the information matrix | log_score: Logarithmic score | lower: End of the 95 % interval
lowest_um: Deviation | machine: Its name | machine_hours: At the machine | machines: One by one, or their number | map: Of --map, or of [map]
max: Largest | mean: Mean | mean_radial_um: Of the path | mean_radius: Of the circle, um | mean_se: Standard error of the mean
mean_square: Share of the mean square | mean_um: Mean | meaning: In words | measured: Value | median: Median
median_ci95: 95 % confidence interval | median_um: Median | message: In words | min: Smallest | minimum_zone: Width of the zone, um
missing: Questions without an answer | modes: What moves in each | motions: Number | moves_most: Body with most kinetic energy
multiplier: Of the contact | n: Number | name: Its name | names: Spellings | nearest: In words | nearest_mm: To a body of the machine
negative: The length counts the other way | noise: Of the measured responses | nominal: Without errors | nominal_direction: Without errors
nominal_facets: Of the nominal shape | nominal_from_part: How the part was aligned | nominal_point_mm: Without errors
normalised: In standard deviations | not_separated: Parameters that act alike | note: Number of notes
null_space: What stays open | number: Number of the tool | observability: What the measurements can show
omega_rad_s: Of the circle | on_cmm: Measured on a CMM | on_machine: Measured on the machine | on_surface: A surface is there
one_factor: The same factor on all | operation: Of the job | operator: Who measured | options: Its options | order: Of the customer
origin_mm: Of the datum system | other_body: That it meets | outlier: Beyond what the noise explains | over_mm: It dies away over this travel
p: Probability or share | p95: Of 95 % | parameters: Factors that were found | part: Its name | part_number: Its number
pass_deg: With the overshoot | passed: Number | passes: Within its limits | pattern: Its name | patterns: Step patterns
peak_um: Largest in the move | phase_deg: Phase | phasor_x_um: Amplitudes of harmonics | phasor_y_um: Amplitudes of harmonics
place_mm: Of the tool tip | plane: Of the circle or arc | point: Where, or which | point_mm: Of the line | point_off_um: From nominal
points: Number, or each of them | poles: Of the controlled machine | poses: Positions | positional: It has no dashes
predicted: By the estimates | pretravel_um: Of the probe | probability: Probability | probing_form_um: Of 25 points of a sphere
probing_limit_um: Of the form | probing_size_um: Deviation of the sphere's size | producer: Risk that a good part is rejected
program: The program | programmed_feed: As written | proven: Number that interval arithmetic proved | q1: Lower quartile
q3: Upper quartile | q95_um: 95 % quantile | quantiles: By probability | quantity: Which | radius_mm: Of the circle
range: Largest less smallest | rank: Number of independent unknowns | ranking: Errors by their share | ranks: Of MPI
rates: Of --rates | reached_feed: Within the limits | reading_um: Of the instrument | real_poles_1_s: Overdamped ones | reason: Why
recipe: Closed formulas as printed | recipe_corrected: Closed formulas, corrected | refuted: Number that interval arithmetic refuted
regular: Number whose surface is regular there | rejected: The model does not explain them | relative: Tool to workpiece
relative_standard_uncertainty: Of the factor | relative_um: Tool to workpiece | removed_mm3: Removed | removed_volume_mm3: Removed
repeat: Number of calibrations | repetition: Its number | required: It must be given | residual: Measured less predicted
residual_rms: What is left over, um | residual_um: Of each reading | residuals: Of every value | resolution_um: Of a reading
risks: By rule of decision | rms: Root mean square | rms_um: Root mean square | rmse: Root mean square error, um
rotation: Three rows | roundness_lsq_um: About the least-squares circle | rows: Of the map, or of the table | rule: Of decision
samples: Number of draws | scatter: Standard deviation over the calibrations | scheme: How draws are spread | sd: Standard deviation
sd_um: Standard deviation | se: Standard errors | second_file: Of the second program | second_line: Of the second program
second_um_per_gn: Of the other machine | seconds: Time of the work | seed: Of the draws | sense: normal or radial
serial_number: Of the part | setup_found_um: Errors of the set-up that the readings show | setup_sheet: For the operator
setup_um: Errors of the set-up that were put in | severity: error, warning or note | sha256: Digest | share: Of the mean square
shares: Which errors make it | shown: Share of the errors that show | side: tool or workpiece | signature_without: Without spikes
singular: At a pole | singular_values: Of the scaled system | skill: 1 - CRPS / CRPS of the laws | smallest: Set that does
smallest_identifying: Smallest sets that identify all | standard_uncertainty: Of it | static_compliance_um_per_n: At rest
static_stiffness_n_per_um: At rest, as measured | status: pass or fail | stay: Errors that show as on a CMM | step: Of the recipe
strain_share: Of the strain energy | stroke_um: Of the bar | structure: Structure code | suppressed: By a remark or a baseline
suspects: Readings that are most likely wrong | table_ball: Table ball off | table_ball_mm: Frame of the table
taken_as_exact: Known without --known | targets_mm: Where it was read | temperature_degC: As stated in the trace | test: Which test
tests: Chosen | text: In words | threads: Number | time_ratio: Of the block | times: Of the axis | tip_in_machine_mm: At rest
tip_in_machine_um: Deviation | tip_in_table_um: Deviation | tip_um: Difference of the tips | title: Of the study | to_um: Upper end
tolerance_um: Of --tolerance | tool: Tool side | tool_length_mm: From the gauge point to the tip | tool_um: Of the tool side
tool_vectors: Tool axes come as vectors | total: Total index | total_se: Its standard error | touches: Number
translation_mm: Its translation | travels: Of the axes | turn_in_table_urad: Of the tool | turns: Whole turns of an arc
um: Translations | undamped_hz: Natural frequencies | unexpected: Files that do not belong there | unit: Of the values beside it
units: Of the columns | unknowns: What is sought | unreachable: Step patterns beyond the travels | upper: End of the 95 % interval
urad: Rotations | url: Address | value: In its unit | value_um: Value | values: Of the quantity | visible: What the machine's errors show there
volume_mm3: Volume | w: Of Baarda's test | warning: Number of warnings | within_2sd: Share within two standard deviations
within_budget: Best set of no more hours | within_deg: To either side | within_percent: Of the points | within_travel: All axes are
without_effect: Errors that do nothing here | words: Values that it takes | workpiece: Workpiece side | workpiece_um: Of the workpiece side
worst: The largest | worst_bound_um: Of the point that is known worst | yields_most: Connection with most strain energy
zero_by_choice: Errors that the reference axes make zero | frustum_baseline: Form of the file | null: Nothing | times: Factor
"""
MEANINGS = {name.strip(): meaning.strip() for each in _TEXT.replace("\n", "|").split("|") if ":" in each
            for name, meaning in [each.split(":", 1)]}


def described(schema):
    """The same, in which every key says what it means."""
    if not isinstance(schema, dict):
        return schema
    changed = dict(schema)
    if "properties" in schema:
        changed["properties"] = {}
        for name, each in schema["properties"].items():
            inner = described(each)
            if not inner.get("description") and name in MEANINGS:
                inner = {"description": MEANINGS[name], **inner}
            changed["properties"][name] = inner
    for key in ("items", "additionalProperties"):
        if key in schema:
            changed[key] = described(schema[key])
    if "patternProperties" in schema:
        changed["patternProperties"] = {key: described(each) for key, each in schema["patternProperties"].items()}
    if "anyOf" in schema:
        changed["anyOf"] = [described(each) for each in schema["anyOf"]]
    return changed
