"""Random mechanisms as files, drawn closed and regular over every kind of joint and force."""
