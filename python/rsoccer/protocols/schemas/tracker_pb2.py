"""Messages of tracker.proto, made by `python -m tools.make_schemas`."""

from rsoccer.protocols.schemas import pool

_SERIALIZED = (
    b'\n\'rsoccer/protocols/schemas/tracker.proto\x12\x0frsoccer.tracker"\x81\x01\n\x06Packet\x12'
    b'\x12\n\x04uuid\x18\x01 \x02(\tR\x04uuid\x12\x1f\n\x0bsource_name\x18\x02 \x01(\tR\nsourceName'
    b'\x12B\n\rtracked_frame\x18\x03 \x01(\x0b2\x1d.rsoccer.tracker.TrackedFrameR\x0ctrackedFrame"'
    b'\xb9\x02\n\x0cTrackedFrame\x12!\n\x0cframe_number\x18\x01 \x02(\rR\x0bframeNumber\x12\x1c\n\t'
    b'timestamp\x18\x02 \x02(\x01R\ttimestamp\x122\n\x05balls\x18\x03 \x03(\x0b2\x1c.rsoccer.tracke'
    b'r.TrackedBallR\x05balls\x125\n\x06robots\x18\x04 \x03(\x0b2\x1d.rsoccer.tracker.TrackedRobotR'
    b'\x06robots\x12<\n\x0bkicked_ball\x18\x05 \x01(\x0b2\x1b.rsoccer.tracker.KickedBallR\nkickedBa'
    b'll\x12?\n\x0ccapabilities\x18\x06 \x03(\x0e2\x1b.rsoccer.tracker.CapabilityR\x0ccapabilities"'
    b'%\n\x07Vector2\x12\x0c\n\x01x\x18\x01 \x02(\x02R\x01x\x12\x0c\n\x01y\x18\x02 \x02(\x02R\x01y"'
    b'3\n\x07Vector3\x12\x0c\n\x01x\x18\x01 \x02(\x02R\x01x\x12\x0c\n\x01y\x18\x02 \x02(\x02R\x01y'
    b'\x12\x0c\n\x01z\x18\x03 \x02(\x02R\x01z"T\n\x07RobotId\x12\x0e\n\x02id\x18\x01 \x02(\rR\x02id'
    b'\x129\n\nteam_color\x18\x02 \x02(\x0e2\x1a.rsoccer.tracker.TeamColorR\tteamColor"\x85\x01\n'
    b'\x0bTrackedBall\x12*\n\x03pos\x18\x01 \x02(\x0b2\x18.rsoccer.tracker.Vector3R\x03pos\x12*\n'
    b'\x03vel\x18\x02 \x01(\x0b2\x18.rsoccer.tracker.Vector3R\x03vel\x12\x1e\n\nvisibility\x18\x03 '
    b'\x01(\x02R\nvisibility"\xfe\x01\n\x0cTrackedRobot\x123\n\x08robot_id\x18\x01 \x02(\x0b2\x18.r'
    b'soccer.tracker.RobotIdR\x07robotId\x12*\n\x03pos\x18\x02 \x02(\x0b2\x18.rsoccer.tracker.Vecto'
    b'r2R\x03pos\x12 \n\x0borientation\x18\x03 \x02(\x02R\x0borientation\x12*\n\x03vel\x18\x04 \x01'
    b'(\x0b2\x18.rsoccer.tracker.Vector2R\x03vel\x12\x1f\n\x0bvel_angular\x18\x05 \x01(\x02R\nvelAn'
    b'gular\x12\x1e\n\nvisibility\x18\x06 \x01(\x02R\nvisibility"\x9e\x02\n\nKickedBall\x12*\n\x03p'
    b'os\x18\x01 \x02(\x0b2\x18.rsoccer.tracker.Vector2R\x03pos\x12*\n\x03vel\x18\x02 \x02(\x0b2'
    b"\x18.rsoccer.tracker.Vector3R\x03vel\x12'\n\x0fstart_timestamp\x18\x03 \x02(\x01R\x0estartTim"
    b'estamp\x12%\n\x0estop_timestamp\x18\x04 \x01(\x01R\rstopTimestamp\x123\n\x08stop_pos\x18\x05 '
    b'\x01(\x0b2\x18.rsoccer.tracker.Vector2R\x07stopPos\x123\n\x08robot_id\x18\x06 \x01(\x0b2\x18.'
    b'rsoccer.tracker.RobotIdR\x07robotId*\x92\x01\n\nCapability\x12\x16\n\x12CAPABILITY_UNKNOWN'
    b'\x10\x00\x12"\n\x1eCAPABILITY_DETECT_FLYING_BALLS\x10\x01\x12$\n CAPABILITY_DETECT_MULTIPLE_B'
    b'ALLS\x10\x02\x12"\n\x1eCAPABILITY_DETECT_KICKED_BALLS\x10\x03*O\n\tTeamColor\x12\x16\n\x12TEA'
    b'M_COLOR_UNKNOWN\x10\x00\x12\x15\n\x11TEAM_COLOR_YELLOW\x10\x01\x12\x13\n\x0fTEAM_COLOR_BLUE'
    b'\x10\x02'
)
globals().update(pool.load(
    _SERIALIZED,
))
