"""Tests of each rule of the referee, for the table of docs/referee.md.

A rule has a scene that it judges, one in which something is just allowed, and one with an exception
or an advantage. Tests are named by their module in `crates/rsim-referee/tests/LEAGUE/`.
"""

from typing import Final

from benches.markdown import table

FOLDER: Final = "crates/rsim-referee/tests"

SSL: Final = {
    "ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA": (
        "areas::a_touch_that_lasts_is_raised_every_two_seconds_and_a_new_one_at_once",
        "areas::an_attacker_that_is_partly_inside_must_not_touch_the_ball",
        "areas::before_a_kick_nobody_is_judged_for_touches_in_areas",
    ),
    "BOT_KICKED_BALL_TOO_FAST": (
        "touches::a_ball_must_not_be_kicked_faster_than_the_limit_in_three_dimensions",
        "limits::a_robot_may_kick_at_the_limit_and_keep_a_fast_ball_as_fast_as_it_is",
        "touches::a_flight_is_one_foul_and_so_is_a_fast_ball_that_another_robot_deflects",
    ),
    "BOT_CRASH_UNIQUE": (
        "contacts::the_faster_robot_of_a_crash_is_at_fault",
        "limits::a_contact_at_one_and_a_half_meters_per_second_is_no_crash",
        "contacts::a_crash_of_teammates_is_none",
    ),
    "BOT_CRASH_DRAWN": (
        "contacts::both_are_at_fault_at_about_the_same_speed",
        "contacts::a_slow_contact_is_no_crash",
        "contacts::a_drawn_crash_is_a_foul_of_one_team_while_that_of_the_other_lasts",
    ),
    "INVALID_GOAL": (
        "goals::a_ball_that_was_too_high_scores_no_goal",
        "limits::a_ball_that_was_as_high_as_it_may_be_scores",
        "goals::a_foul_before_the_kick_does_not_speak_against_a_goal",
    ),
    "GOAL": (
        "goals::a_goal_counts_and_the_others_kick_off",
        "goals::beside_and_above_the_goal_and_before_the_line_is_no_goal",
        "goals::a_ball_in_the_goal_while_play_is_stopped_is_no_goal",
    ),
    "BOUNDARY_CROSSING": (
        "ball_out::a_ball_that_flies_over_the_wall_is_a_foul",
        "ball_out::a_ball_that_meets_the_wall_is_only_out",
        "ball_out::nobody_is_at_fault_for_a_flight_without_a_touch",
    ),
    "AIMLESS_KICK": (
        "ball_out::a_kick_from_the_own_half_over_the_far_goal_line_is_aimless_in_division_b",
        "ball_out::a_ball_that_another_robot_touched_on_its_way_or_from_the_far_half_is_not_aimless",
        "ball_out::a_kick_off_is_never_aimless_but_a_later_kick_of_the_same_robot_is",
    ),
    "BALL_LEFT_FIELD_TOUCH_LINE": (
        "ball_out::a_ball_over_a_touch_line_is_thrown_in_by_the_others",
        "ball_out::a_ball_that_has_not_crossed_a_line_completely_is_on_the_field",
        "ball_out::a_ball_that_nobody_touched_since_play_went_on_is_free_for_both",
    ),
    "BALL_LEFT_FIELD_GOAL_LINE": (
        "ball_out::over_the_line_of_the_others_it_is_a_goal_kick_and_over_the_own_one_a_corner_kick",
        "ball_out::a_ball_that_has_not_crossed_a_line_completely_is_on_the_field",
        "touchers::a_ball_that_nobody_touched_is_free_for_both_or_a_goal",
    ),
    "DEFENDER_IN_DEFENSE_AREA": (
        "areas::a_second_defender_that_is_entirely_inside_costs_a_penalty_kick",
        "areas::a_defender_inside_that_does_not_touch_the_ball_is_no_offense",
        "areas::the_keeper_may_touch_the_ball_in_its_area",
    ),
    "ATTACKER_DOUBLE_TOUCHED_BALL": (
        "touches::the_kicker_must_not_touch_the_ball_again",
        "touches::after_a_touch_of_any_other_robot_the_kicker_may_play_again",
        "penalty::the_kicker_may_touch_the_ball_again",
    ),
    "BOT_DRIBBLED_BALL_TOO_FAR": (
        "touches::a_robot_must_not_dribble_farther_than_a_meter",
        "limits::a_robot_may_dribble_a_meter",
        "touches::a_kick_at_the_end_of_a_dribble_is_no_dribbling",
    ),
    "KEEPER_HELD_BALL": (
        "areas::each_area_counts_against_its_own_team",
        "areas::the_ball_must_not_stay_in_an_area",
        "areas::the_time_in_an_area_begins_anew_when_the_ball_leaves_it",
    ),
    "BOT_PUSHED_BOT": (
        "contacts::a_robot_must_not_push_an_opponent",
        "contacts::a_short_way_a_way_aside_and_a_turn_are_no_push",
        "contacts::pushes_in_a_stop_are_not_judged",
    ),
    "ATTACKER_TOO_CLOSE_TO_DEFENSE_AREA": (
        "stops::a_robot_that_stays_too_close_to_the_area_is_a_foul",
        "stops::two_decimeters_and_a_short_stay_are_far_enough",
        "stops::areas_are_free_in_play_and_before_other_kicks",
    ),
    "NO_PROGRESS_IN_GAME": (
        "limits::a_decimeter_is_no_progress_yet",
        "touches::a_decimeter_is_progress",
        "touches::before_a_kick_the_ball_may_rest",
    ),
    "DEFENDER_TOO_CLOSE_TO_KICK_POINT": (
        "stops::a_robot_that_is_too_close_to_the_kick_is_a_foul",
        "stops::half_a_meter_and_the_kicking_team_are_no_foul",
        "stops::in_play_and_in_stops_nobody_is_too_close_to_the_ball",
    ),
    "BOT_TOO_FAST_IN_STOP": (
        "stops::a_robot_that_is_too_fast_in_a_stop_is_a_foul_once",
        "limits::a_robot_may_drive_at_the_limit_in_a_stop",
        "stops::the_speed_limit_is_that_of_stops_alone",
    ),
    "BOT_INTERFERED_PLACEMENT": (
        "placement::who_stays_in_the_way_commits_one_foul_and_gives_time_each_time",
        "limits::a_robot_half_a_meter_beside_the_way_of_a_placement_does_not_interfere",
        "placement::who_is_beside_the_way_leaves_it_in_time_or_places_does_not_interfere",
    ),
    "PLACEMENT_SUCCEEDED": (
        "placement::a_placed_ball_gives_the_free_kick_after_two_seconds",
        "limits::a_placed_ball_is_slower_than_one_decimeter_per_second",
        "placement::before_a_force_start_robots_keep_half_a_meter",
    ),
    "PLACEMENT_FAILED": (
        "placement::after_thirty_seconds_a_placement_has_failed",
        "placement::a_ball_that_is_placed_in_the_last_step_is_placed",
        "placement::the_referee_places_the_ball_where_the_others_do_not_stop_to_interfere",
    ),
    "UNSPORTING_BEHAVIOR_MINOR": (
        "penalty_positions::a_keeper_that_leaves_its_line_before_the_kick_gives_a_goal",
        "penalty_positions::a_keeper_that_touches_its_line_may_move_between_the_posts",
        "penalty_positions::the_keeper_may_leave_its_line_with_the_kick",
    ),
    "PENALTY_KICK_FAILED": (
        "penalty::a_keeper_that_turns_the_ball_by_a_right_angle_saves",
        "penalty::only_a_touch_of_the_keeper_saves",
        "penalty::a_foul_of_both_decides_nothing",
    ),
}
"""Tests of the rules of SSL: what is judged, what is just allowed, an exception."""

VSSS: Final = {
    "GOAL": (
        "goals::a_ball_fully_over_the_line_is_a_goal",
        "goals::a_ball_on_the_line_is_no_goal",
        "goals::a_goal_after_two_attackers_in_the_area_is_a_goal_kick",
    ),
    "ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA": (
        "crowds::two_robots_in_the_goal_area_with_the_ball_are_a_foul_after_three_seconds",
        "crowds::a_robot_or_the_ball_just_outside_the_goal_area_does_not_count",
        "crowd_limits::where_both_teams_are_too_many_there_is_one_foul",
    ),
    "DEFENDER_IN_DEFENSE_AREA": (
        "crowds::the_foul_is_given_when_the_ball_leaves_the_large_area",
        "crowds::one_robot_in_the_goal_area_is_allowed",
        "shootout::crowds_are_not_judged_in_the_shoot_out",
    ),
    "KEEPER_HELD_BALL": (
        "stuck_ball::a_ball_that_is_stuck_in_a_goal_area_is_a_penalty_kick",
        "stuck_ball::the_time_begins_again_when_the_ball_enters_or_leaves_a_goal_area",
        "stuck_ball::a_ball_between_both_teams_in_a_goal_area_is_a_free_ball",
    ),
    "NO_PROGRESS_IN_GAME": (
        "stuck_ball::a_ball_that_is_stuck_for_five_seconds_is_a_free_ball_in_its_quarter",
        "stuck_ball::a_ball_that_rolls_slowly_is_stuck_and_a_faster_one_is_not",
        "stuck_ball::a_ball_at_rest_is_not_stuck_while_play_is_stopped",
    ),
    "PENALTY_KICK_FAILED": (
        "shootout::a_kick_fails_after_ten_seconds",
        "shootout::a_goal_in_the_last_step_of_a_kick_counts",
        "shootout::a_penalty_kick_of_a_half_does_not_fail",
    ),
}
"""The same of VSSS."""


def ssl_scenes() -> str:
    """Return the table of the tests of SSL's rules."""
    return _table(SSL)


def vsss_scenes() -> str:
    """Return the table of the tests of VSSS's rules."""
    return _table(VSSS)


def _table(scenes: dict[str, tuple[str, str, str]]) -> str:
    """The table of the tests of a league."""
    rows = [tuple(f"`{cell}`" for cell in (rule, *tests)) for rule, tests in scenes.items()]
    return table(("rule", "judged", "just allowed", "exception"), rows)
