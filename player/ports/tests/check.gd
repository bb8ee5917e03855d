# Replays a golden trace with gambol_player.gd; for Godot 3. From a folder that holds a copy of both (Godot writes into it):
#
#     godot3-server --path . --script check.gd all-senses.player all-senses.trace.csv
#
# with absolute paths of the two files. Prints the greatest difference, and fails where something is wrong. A last column
# `faces_left` of the trace says when the body turns round. Without a trace, prints of each file whether its body looks the same
# from both sides.

extends SceneTree

const Gambol = preload("res://gambol_player.gd")
const MOST = 1.0e-5

var _bytes
var _columns = []
var _rows = []
var _turns = false
var _failures = 0
var _exit_code = 1


func _init():
	var paths = []
	for argument in OS.get_cmdline_args():
		if argument.ends_with(".player") or argument.ends_with(".csv"):
			paths.append(argument)
	if paths.back().ends_with(".csv"):
		_check(paths[0], paths[1])
	else:
		for path in paths:
			print(_symmetry(path))
	if _failures == 0:
		_exit_code = 0
		print("checked")


func _check(path, trace):
	var character = _character(path)
	if _failures > 0:
		return
	var file = File.new()
	file.open(trace, File.READ)
	var lines = file.get_as_text().strip_edges().split("\n")
	file.close()
	_columns = Array(lines[0].split(","))
	_turns = _columns.back() == "faces_left"
	if _turns:
		_columns.pop_back()
	for index in range(1, lines.size()):
		_rows.append(_row(lines[index], character))
	_replay(character)
	_check_damage()
	_check_mirrored(character)
	_check_facing(character)
	_check_lopsided(character, _character(path))
	_check_errors(character)


func _character(path):
	var file = File.new()
	file.open(path, File.READ)
	_bytes = file.get_buffer(file.get_len())
	file.close()
	var character = Gambol.Character.new()
	_assert_equal(character.read(_bytes), "")
	return character


# Whether a body looks the same from both sides, or why not.
func _symmetry(path):
	var why = _character(path).symmetry()
	return "symmetric" if why == "" else why


# An error of the script ends a function, and Godot goes on: so it ends here whatever happens.
func _idle(_seconds):
	quit(_exit_code)


func _assert(holds, what):
	if not holds:
		_failures += 1
		print("wrong: ", what)


func _assert_equal(found, expected):
	_assert(found == expected, "\"%s\", not \"%s\"" % [found, expected])


# What a row of a trace tells a player, and what it must give: seconds, inputs, outputs, speeds.
func _row(line, character):
	var numbers = []
	for number in line.split(","):
		numbers.append(float(number))
	var row = {"parts": [], "outside": [], "command": _command(numbers[2], numbers[3] != 0.0), "expected": [numbers[1]]}
	row.facing = "left" if _turns and numbers.pop_back() == 1.0 else "right"
	var at = 4
	for _part in character.parts:
		row.parts.append(_state(numbers, at))
		at += 8
	var measured = at + character.outside().size()
	for index in range(at, numbers.size()):
		(row.outside if index < measured else row.expected).append(numbers[index])
	return row


func _command(speed, jump):
	var command = Gambol.Command.new()
	command.speed = speed
	command.jump = jump
	return command


func _state(numbers, at):
	var state = Gambol.PartState.new()
	state.x = numbers[at]
	state.y = numbers[at + 1]
	state.cosine = numbers[at + 2]
	state.sine = numbers[at + 3]
	state.vx = numbers[at + 4]
	state.vy = numbers[at + 5]
	state.spin = numbers[at + 6]
	state.touching = numbers[at + 7] != 0.0
	return state


func _replay(character):
	var player = Gambol.Player.new(character)
	var greatest = 0.0
	var where = "anywhere"
	for step in range(_rows.size()):
		var row = _rows[step]
		var seconds = player.seconds
		_assert_equal(player.face(row.facing), "")
		_assert_equal(player.tick(row.parts, row.outside, row.command, character.world.time_step), "")
		var found = [seconds] + player.inputs + player.outputs + player.speeds
		_assert_equal(found.size(), row.expected.size())
		for index in range(found.size()):
			var expected = row.expected[index]
			var difference = abs(found[index] - expected) / max(1.0, abs(expected))
			_assert(difference <= MOST, "%s, not %s, in step %d" % [found[index], expected, step])
			if difference > greatest:
				greatest = difference
				where = "seconds" if index == 0 else _columns[_columns.size() - found.size() + index]
				where += ", step %d" % step
	print("greatest difference %.4fe-6 (%s)" % [greatest * 1.0e6, where])


func _refusal(bytes):
	return Gambol.Character.new().read(bytes)


func _flipped(place, bits):
	var bytes = _bytes
	bytes.set(place, bytes[place] ^ bits)
	return bytes


func _check_damage():
	# Not each place: it takes long here.
	for place in range(0, _bytes.size(), 5):
		var why = "the digest does not fit"
		if place < 16:
			why = "not a character" if place < 8 else ("version" if place < 12 else "cut or added to")
		var refusal = _refusal(_flipped(place, 4))
		_assert(why in refusal, "refused with \"%s\", not \"%s\"" % [refusal, why])
	_assert("cut or added to" in _refusal(_bytes.subarray(0, _bytes.size() - 2)), "a file that was cut is played")
	_assert("not a character" in _refusal(_bytes.subarray(0, 19)), "half a header is played")
	_assert("not a character" in _refusal(PoolByteArray()), "nothing is played")
	_assert_equal(_refusal(_flipped(8, 1)), "version 3 of the format; this player reads version 2")


func _mirrored(part):
	var state = Gambol.PartState.new()
	for field in ["x", "sine", "vx", "spin"]:
		state.set(field, -part.get(field))
	for field in ["y", "cosine", "vy", "touching"]:
		state.set(field, part.get(field))
	return state


# The mirror image does the same the other way.
func _check_mirrored(character):
	var right = Gambol.Player.new(character)
	var left = Gambol.Player.new(character.mirrored())
	for row in _rows:
		var mirrored = []
		for part in row.parts:
			mirrored.append(_mirrored(part))
		_assert_equal(right.face(row.facing), "")
		_assert_equal(left.face("left" if row.facing == "right" else "right"), "")
		_assert_equal(right.tick(row.parts, row.outside, row.command, 0.02), "")
		_assert_equal(left.tick(mirrored, row.outside, row.command, 0.02), "")
		var torques = right.torques(row.parts)
		var others = left.torques(mirrored)
		for index in range(torques.size()):
			_assert_equal(right.speeds[index], -left.speeds[index])
			_assert_equal(torques[index], -others[index])


# A body turns round, and back; rays turn with it.
func _check_facing(character):
	var player = Gambol.Player.new(character)
	_assert_equal(player.facing(), "right")
	_assert_equal(str(player.outside()), str(character.outside()))
	_assert_equal(player.face("left"), "")
	_assert_equal(player.facing(), "left")
	_assert_equal(str(player.outside()), str(character.mirrored().outside()))
	var rays = 0
	for outside in character.outside():
		rays += 1 if outside.kind == Gambol.Source.RAY else 0
	_assert((str(player.outside()) != str(character.outside())) == (rays > 0), "rays do not turn")
	_assert_equal(player.face("right"), "")
	_check_same(player, Gambol.Player.new(character))
	_assert_equal(player.face("left"), "")
	player.reset()
	_assert_equal(player.facing(), "right")
	_check_same(player, Gambol.Player.new(character))
	var built = Gambol.Player.new(character.mirrored())
	_assert_equal(built.face("right"), "")
	built.reset()
	_assert_equal(built.facing(), "left")
	_assert_equal(player.face("Left"), "\"Left\": must be \"left\" or \"right\"")


# One that does not look the same from both sides goes on as it was.
func _check_lopsided(character, lopsided):
	lopsided.parts.back().x += 0.1
	var player = Gambol.Player.new(lopsided)
	var other = Gambol.Player.new(character)
	_check_same(player, other)
	var error = player.face("left")
	_assert("has no mirror image on the other side" in error, "\"%s\", not that there is no mirror image" % error)
	_assert_equal(player.facing(), "right")
	_check_same(player, other)
	_assert_equal(player.face("right"), "")


func _check_same(one, other):
	for index in range(3):
		var row = _rows[index]
		_assert_equal(one.tick(row.parts, row.outside, row.command, 0.02), "")
		_assert_equal(other.tick(row.parts, row.outside, row.command, 0.02), "")
		_assert_equal(one.speeds, other.speeds)


# What a game tells wrongly leaves the motors still.
func _check_errors(character):
	var player = Gambol.Player.new(character)
	var row = _rows[0]
	player.tick(row.parts, row.outside, row.command, 0.02)
	var first = player.speeds.duplicate()
	var fewer = row.parts.duplicate()
	fewer.pop_back()
	var fallen = row.parts.duplicate()
	fallen[1] = _mirrored(fallen[1])
	fallen[1].vx = NAN
	var blown = row.parts.duplicate()
	blown[1] = _mirrored(blown[1])
	blown[1].sine = INF
	_check_still(player, fewer, row.outside, row.command, 0.02, "parts, and the character has")
	_check_still(player, row.parts, row.outside + [1.0], row.command, 0.02, "measurements of what is outside")
	_check_still(player, row.parts, row.outside, row.command, -0.1, "the time of a frame")
	_check_still(player, row.parts, row.outside, row.command, NAN, "the time of a frame")
	_check_still(player, fallen, row.outside, row.command, 0.02, "not finite")
	_check_still(player, blown, row.outside, row.command, 0.02, "not finite")
	_check_still(player, row.parts, row.outside, _command(NAN, false), 0.02, "not finite")
	player.reset()
	player.tick(row.parts, row.outside, row.command, 0.02)
	_assert_equal(player.speeds, first)


func _check_still(player, parts, outside, command, seconds, why):
	player.tick(_rows[0].parts, _rows[0].outside, _rows[0].command, 0.02)
	_assert(player.speeds.max() > 0.0 or player.speeds.min() < 0.0, "the motors hold still")
	var error = player.tick(parts, outside, command, seconds)
	_assert(why in error, "\"%s\", not \"%s\"" % [error, why])
	for speed in player.speeds:
		_assert_equal(speed, 0.0)
	if why == "not finite":
		for output in player.outputs:
			_assert_equal(output, 0.0)
