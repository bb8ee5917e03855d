# Plays a trained character of Gambol: from the state of its body to the speeds of its motors, once a frame.
#
# Copy this file into a game; it needs nothing else. docs/player.md is the specification of the file format and of
# everything that is computed. MIT OR Apache-2.0.
#
#     const Gambol = preload("res://gambol_player.gd")
#     var character = Gambol.Character.new()
#     var error = character.read(bytes)            # of a `.player` file; "" or why they are not a character
#     var player = Gambol.Player.new(character)    # after a body is built from character.parts and character.hinges
#     error = player.tick(parts, outside, command, delta)    # each physics frame; then player.speeds
#
# Units: metres, kilograms, seconds, radians; x points forward, y up; angles count counter-clockwise. In Godot's 2D y points
# down: change the sign of y, angle, sine, vy and spin of all parts, of anchors' y, of rays' angles, and of speeds and torques;
# multiply lengths by the pixels of a metre; and swap the limits of hinges with both signs changed.
#
# Checked with Godot 3.2.3. It is written so that Godot 4 takes the same file, and fits that grammar, but it has not been run
# there. What a game does around it differs: a file's bytes come from `File.get_buffer` in Godot 3, from
# `FileAccess.get_file_as_bytes` in Godot 4.
#
# Godot computes with 64 bits: numbers are rounded to 32 where the original rounds them and it matters. A Godot that was
# built for vectors of 64 bits does not round all of them.

# The version of the format that this file reads.
const VERSION = 2

const HEADER = 24
const MOST_NODES = 65536
const MAGIC = [0x47, 0x41, 0x4d, 0x42, 0x4f, 0x4c, 0x50, 0x4c]
# The shortest records, in bytes: a count that promises more than the file holds is not believed.
const NUMBER = 4
const SHORTEST_PART = 10
const SHORTEST_HINGE = 9
const SHORTEST_OUTPUT = 2
const SHORTEST_INPUT = 6
const SHORTEST_NEURON = 4
const SHORTEST_SOURCE = 2

# What an input shows, with its number in a file.
enum Source {
	TORSO_ROTATION, TORSO_SPIN, JOINT_ANGLE, JOINT_SPEED, VELOCITY_FORWARD, VELOCITY_UP, TORSO_HEIGHT, CONTACT, RAY, SLIP,
	GAP_DISTANCE, GAP_WIDTH, CLOCK_SINE, CLOCK_COSINE, LANDING_SINE, LANDING_COSINE, COMMANDED_SPEED, JUMP_COMMAND,
	STRIDE_SINE, STRIDE_COSINE, JUMP_SINE, JUMP_SWELL
}

# The function that turns the sum of a neuron into its output, with its number in a file.
enum Activation { LOGISTIC, TANH, RATIONAL_TANH, RELU, LINEAR, SINE, GAUSSIAN, STEEP_LOGISTIC, STEEP_TANH }

# The longest a frame may last, s.
const LONGEST_FRAME = 1.0
# What touches within this time of a landing belongs to it, s: feet come down one after the other, and bounce.
const ONE_LANDING = 0.2
# Longer ago than any press, s.
const NEVER = 1.0e9
const NOT_FINITE = "a number is not finite; the motors hold still and the net begins anew"


# Where a part of the body is and how it moves.
class PartState:
	# Centre, forward and up, m.
	var x = 0.0
	var y = 0.0
	# Cosine and sine of its angle against the world, counter-clockwise.
	var cosine = 1.0
	var sine = 0.0
	# Velocity of the centre, forward and up, m/s.
	var vx = 0.0
	var vy = 0.0
	# Angular speed, counter-clockwise, rad/s.
	var spin = 0.0
	# Whether it touches the ground.
	var touching = false


# What the character is told to do.
class Command:
	# How fast to go, body lengths/s, the way the character faces; backwards below 0. Values beyond what it was trained for
	# count as the fastest.
	var speed = 0.0
	# Whether the button that means jump is held.
	var jump = false


class Numbers:
	# The nearest number of 32 bits to one that is finite (Veltkamp's splitting).
	static func single(number):
		var scaled = number * 536870913.0
		return scaled - (scaled - number)

	static func is_finite_number(number):
		# The difference of what is not finite is not 0.
		return number - number == 0.0

	static func mirrored_limits(limits):
		return [-limits[1], -limits[0]]

	static func is_outside(source):
		return source == Source.RAY or source == Source.GAP_DISTANCE or source == Source.GAP_WIDTH

	# What the game has to measure for these inputs.
	static func outside_facing(probes, facing):
		var measured = []
		for probe in probes:
			if probe.source == Source.RAY:
				var angle = PI - probe.first if facing == "left" else probe.first
				measured.append({"kind": probe.source, "angle": angle, "length": probe.second})
			elif is_outside(probe.source):
				measured.append({"kind": probe.source, "length": probe.first})
		return measured

	# The angle of a direction seen from a reference, both (cosine, sine); rad, in (-PI, PI].
	static func angle_from(reference, direction):
		return turned_back(reference, direction).angle()

	# A direction turned back by a reference. Vectors compute with 32 bits, as the original does.
	static func turned_back(reference, direction):
		return Vector2(reference.dot(direction), reference.cross(direction))

	# Phase of a clock, both s; rad, 0 to TAU. Whole turns are dropped first: they would cost precision.
	static func clock_phase(time, period):
		var turns = single(time / period)
		return (turns - floor(turns)) * TAU

	# Half the height of the upright box around a shape that is turned by an angle with this cosine and sine, m.
	static func half_height(shape, c, s):
		match shape.kind:
			"box":
				return 0.5 * (abs(s) * shape.width + abs(c) * shape.height)
			"circle":
				return shape.radius
			_:
				return 0.5 * abs(c) * shape.length + shape.radius

	# Limited as the original, which keeps it finite.
	static func exponential(x):
		return exp(clamp(x, -87.0, 87.0))

	static func rational_tanh(a):
		return clamp(a * (27.0 + a * a) / (27.0 + 9.0 * a * a), -1.0, 1.0)

	# The output of a neuron for the weighted sum of its sources.
	static func activated(activation, a):
		match activation:
			Activation.TANH:
				return tanh(a)
			Activation.LINEAR:
				return a
			Activation.RELU:
				return 0.0 if a < 0.0 else a
			Activation.LOGISTIC:
				return 1.0 / (1.0 + exponential(-a))
			Activation.RATIONAL_TANH:
				return rational_tanh(clamp(a, -3.0, 3.0))
			Activation.SINE:
				# Limited as the original; not a number for infinities.
				return sin(clamp(a, -4294967296.0, 4294967296.0)) + a * 0.0
			Activation.GAUSSIAN:
				return exponential(-(a * a))
			Activation.STEEP_LOGISTIC:
				return 1.0 / (1.0 + exponential(-4.9 * a))
			_:
				return tanh(2.45 * a)


# Reads fields one after the other, the lowest byte first. After an error all fields are 0.
class Reader:
	# "" or what is wrong.
	var error = ""
	# What is read, for errors.
	var field = "name"
	var bytes
	var _stream = StreamPeerBuffer.new()
	var _numbers = []
	var _rest = 0

	func _init(bytes_):
		bytes = bytes_
		_stream.data_array = bytes_
		_rest = bytes_.size()

	func at():
		return _stream.get_position()

	func rest():
		return _rest

	func fail(why):
		if error == "":
			error = why

	func is_sound():
		return error == ""

	func check(holds, named, index, allowed):
		if not holds:
			fail("%s, number %d: must be %s" % [named, index, allowed])

	# Limits have 32 bits, as the numbers of a file.
	func within(number, low, high, named, index, allowed):
		check(number >= Numbers.single(low) and number <= Numbers.single(high), named, index, allowed)

	func finite(numbers, named, index):
		for number in numbers:
			check(Numbers.is_finite_number(number), named, index, "of finite numbers")

	# Whether so many bytes are there.
	func need(count):
		if count > _rest:
			fail("the file does not end with its last field: %s" % field)
		return is_sound()

	func _take(count):
		if not need(count):
			return false
		_rest -= count
		return true

	func u8():
		return _stream.get_u8() if _take(1) else 0

	# Seven bits a byte, the lowest first; the eighth says that another byte follows.
	func u16():
		var whole = 0
		for place in range(3):
			var byte = u8()
			whole |= (byte & 0x7f) << (7 * place)
			if byte < 0x80 and whole < 65536:
				return whole
		check(false, field, 0, "of whole numbers from 0 to 65535, in at most three bytes")
		return 0

	func u32():
		return _stream.get_u32() if _take(4) else 0

	# The numbers that the rest of the file points at.
	func list_numbers():
		for _index in range(count("numbers", NUMBER)):
			_numbers.append(_stream.get_float() if _take(4) else 0.0)

	# One of them.
	func f32():
		var index = u16()
		check(index < _numbers.size(), field, 0, "of numbers that are listed")
		return _numbers[index] if index < _numbers.size() else 0.0

	func f32s(count):
		var numbers = []
		for _index in range(count):
			numbers.append(f32())
		return numbers

	func code(index, count, allowed):
		var number = u8()
		check(number < count, field, index, allowed)
		return number

	func flag(index):
		return code(index, 2, "0 or 1 where it says yes or no") == 1

	func text(index):
		var length = u8()
		var start = at()
		if length == 0 or not _take(length):
			return ""
		check(_is_utf8(start, start + length), field, index, "named in UTF-8")
		return _stream.get_utf8_string(length) if is_sound() else ""

	# Whether these bytes are UTF-8: nothing longer than it need be, no surrogates, nothing beyond U+10FFFF.
	func _is_utf8(start, end):
		while start < end:
			var first = bytes[start]
			if first < 0x80:
				start += 1
				continue
			var more = 1 if first < 0xe0 else (2 if first < 0xf0 else 3)
			if first < 0xc2 or first > 0xf4 or start + more >= end:
				return false
			for next in range(start + 1, start + more + 1):
				if (bytes[next] & 0xc0) != 0x80:
					return false
			var second = bytes[start + 1]
			if (first == 0xe0 and second < 0xa0) or (first == 0xed and second > 0x9f):
				return false
			if (first == 0xf0 and second < 0x90) or (first == 0xf4 and second > 0x8f):
				return false
			start += more + 1
		return true

	# The number of records, each at least `shortest` bytes long.
	func count(named, shortest):
		field = named
		var records = u16()
		return records if need(records * shortest) else 0

	func some(named, shortest):
		var records = count(named, shortest)
		check(records > 0, named, 0, "from 1 to 65535 of them")
		return records

	# Magic, version, length and digest.
	func header():
		var begins = _rest >= HEADER
		for index in range(MAGIC.size()):
			begins = begins and bytes[index] == MAGIC[index]
		if not begins:
			fail("not a character of Gambol: write one with `gambol export --to player`")
			return
		_stream.seek(MAGIC.size())
		_rest -= MAGIC.size()
		var version = u32()
		var expected = u32()
		var low = u32()
		var high = u32()
		if version != VERSION:
			fail("version %d of the format; this player reads version %d" % [version, VERSION])
		if expected != _rest:
			fail("%d bytes after the header, which says %d: the file was cut or added to" % [_rest, expected])
		if is_sound() and not _has_digest(low, high):
			fail("the digest does not fit: the file was changed after it was written")

	# FNV-1a, 64 bits, in two halves: signed numbers hold the products.
	func _has_digest(expected_low, expected_high):
		var low = 0x84222325
		var high = 0xcbf29ce4
		for index in range(HEADER, bytes.size()):
			low = low ^ bytes[index]
			var product = low * 0x1b3
			high = (high * 0x1b3 + (low << 8) + (product >> 32)) & 0xffffffff
			low = product & 0xffffffff
		return low == expected_low and high == expected_high

	func world():
		field = "world"
		var found = {"time_step": f32(), "gravity": f32(), "ground_friction": f32(), "motor_gain": f32()}
		found.body_length = f32()
		found.rest_height = f32()
		found.self_collision = flag(0)
		found.water = {"density": f32(), "drag": f32(), "slip": f32()} if flag(0) else null
		within(found.time_step, 0.001, 0.05, "time step", 0, "from 0.001 to 0.05 s")
		within(found.gravity, 0.0, 100.0, "gravity", 0, "from 0 to 100 m/s²")
		within(found.ground_friction, 0.0, 10.0, "ground friction", 0, "from 0 to 10")
		within(found.motor_gain, 0.01, 1.0e6, "motor gain", 0, "from 0.01 to 1e6")
		within(found.body_length, 0.001, 1.0e4, "body length", 0, "from 0.001 to 10000 m")
		finite([found.rest_height], "rest height", 0)
		if found.water != null:
			within(found.water.density, 0.01, 1.0e5, "water density", 0, "from 0.01 to 1e5 kg/m²")
			within(found.water.drag, 0.0, 10.0, "water drag", 0, "from 0 to 10")
			within(found.water.slip, 0.0, found.water.drag, "water slip", 0, "from 0 to the drag")
		return found

	func part(index):
		var found = {"name": text(index)}
		var kind = code(index, 3, "a box (0), a circle (1) or a capsule (2)")
		var first = f32()
		var second = f32()
		var sizes = [first, second]
		if kind == 0:
			found.shape = {"kind": "box", "width": first, "height": second}
		elif kind == 1:
			found.shape = {"kind": "circle", "radius": first}
			sizes = [first]
		else:
			found.shape = {"kind": "capsule", "length": first, "radius": second}
		found.x = f32()
		found.y = f32()
		found.angle = f32()
		found.density = f32()
		found.friction = f32()
		found.foot = flag(index)
		finite([found.x, found.y, found.angle], "parts", index)
		within(found.density, 0.1, 1.0e4, "parts", index, "as dense as 0.1 to 10000 kg/m²")
		within(found.friction, 0.0, 10.0, "parts", index, "with a friction from 0 to 10")
		for size in sizes:
			within(size, 0.005, 50.0, "parts", index, "of sizes from 0.005 to 50 m")
		return found

	# `hangs`: the parts that hang on an earlier hinge.
	func hinge(index, parts, hangs):
		var found = {"parent": u16(), "child": u16()}
		found.parent_anchor = f32s(2)
		found.child_anchor = f32s(2)
		found.limits = f32s(2)
		found.motor = {"top_speed": f32(), "top_torque": f32()} if flag(index) else null
		var fits = found.parent < found.child and found.child < parts and not hangs.has(found.child)
		check(fits, "hinges", index, "between a part and a later one that hangs on no other")
		hangs[found.child] = true
		finite(found.parent_anchor + found.child_anchor, "hinges", index)
		var limited = "limited from at most 0 to at least 0, within ± 10 rad"
		within(found.limits[0], -10.0, 0.0, "hinges", index, limited)
		within(found.limits[1], 0.0, 10.0, "hinges", index, limited)
		if found.motor != null:
			within(found.motor.top_speed, 0.01, 100.0, "hinges", index, "with a top speed from 0.01 to 100 rad/s")
			within(found.motor.top_torque, 0.01, 1.0e5, "hinges", index, "with a top torque from 0.01 to 1e5 N·m")
		return found

	func input(index, parts, hinges):
		var found = {"source": u8(), "of": u16(), "first": f32(), "second": f32(), "middle": f32(), "factor": f32()}
		check(found.source <= Source.JUMP_SWELL, "inputs", index, "a sensor that this player knows")
		finite([found.middle, found.factor], "inputs", index)
		match found.source:
			Source.JOINT_ANGLE, Source.JOINT_SPEED:
				check(found.of < hinges, "inputs", index, "of a hinge that is there")
			Source.CONTACT, Source.SLIP:
				check(found.of < parts, "inputs", index, "of a part that is there")
			Source.RAY:
				finite([found.first], "inputs", index)
				_length(found.second, index)
			Source.GAP_DISTANCE, Source.GAP_WIDTH:
				_length(found.first, index)
			Source.CLOCK_SINE, Source.CLOCK_COSINE, Source.LANDING_SINE, Source.LANDING_COSINE:
				_period(found.first, index)
			Source.JUMP_SINE, Source.JUMP_SWELL:
				_period(found.first, index)
			Source.STRIDE_SINE, Source.STRIDE_COSINE:
				_period(found.first, index)
				var allowed = "with a top speed from 0.1 to 20 body lengths/s"
				within(found.second, 0.1, 20.0, "inputs", index, allowed)
		return found

	func _length(number, index):
		within(number, 0.0, 1000.0, "inputs", index, "with a reach of at most 1000 m")

	func _period(number, index):
		within(number, 0.02, 100.0, "inputs", index, "with a period from 0.02 to 100 s")

	func neuron(index):
		var found = {"activation": code(index, 9, "an activation that this player knows"), "scale": f32(), "bias": f32()}
		found.sources = []
		found.weights = []
		for _source in range(count("neurons", SHORTEST_SOURCE)):
			found.sources.append(u16())
			found.weights.append(f32())
		finite([found.scale, found.bias], "neurons", index)
		finite(found.weights, "neurons", index)
		return found


# Which part, and which output, is the mirror image of each: across the upright line through the torso; a part in the middle is
# its own.
class Twins:
	# Lengths may differ by so much, m, and angles, rad: files hold decimals.
	const TOLERANCE = 1.0e-4
	const NONE = -1

	# "" or the first part, or hinge, that has no mirror image.
	var error = ""
	var parts = []
	var outputs = []
	var _character
	# The hinge that each part hangs on.
	var _hangs = []

	func _init(character_):
		_character = character_
		for _part in _character.parts:
			parts.append(NONE)
			_hangs.append(NONE)
		for index in range(_character.hinges.size()):
			_hangs[_character.hinges[index].child] = index
		for part in range(parts.size()):
			if error == "" and parts[part] == NONE:
				_match(part)
		if error == "":
			_match_outputs()

	func _match(part):
		var found = NONE
		var looks_alike = false
		for other in range(part, parts.size()):
			if found == NONE and _may_be_twins(part, other):
				looks_alike = true
				if _hinges_are_mirrored(_hangs[part], _hangs[other]):
					found = other
		if found != NONE:
			parts[part] = found
			parts[found] = part
		elif looks_alike:
			error = "the hinge of part %d is not the mirror image of that of its twin" % part
		else:
			error = "part %d has no mirror image on the other side" % part

	func _match_outputs():
		var children = []
		for hinge in _character.outputs:
			children.append(_character.hinges[hinge].child)
		for child in children:
			outputs.append(children.find(parts[child]))

	func _may_be_twins(part, other):
		var above = _parent(part)
		if above != NONE:
			above = parts[above]
		if parts[other] != NONE or _parent(other) != above:
			return false
		return _are_mirrored(_character.parts[part], _character.parts[other], _character.parts[0].x)

	func _parent(part):
		return NONE if _hangs[part] == NONE else _character.hinges[_hangs[part]].parent

	func _are_mirrored(one, other, middle):
		# After half a turn a part looks the same, but its angle, which is sensed, is not.
		var turn = Numbers.single(2.0 * PI)
		var turns = Numbers.single(Numbers.single(one.angle + other.angle) / turn)
		var turned = Numbers.single(Numbers.single(turns - round(turns)) * turn)
		var is_in_place = _near(Numbers.single(one.x - middle), Numbers.single(middle - other.x)) and _near(one.y, other.y)
		var is_alike = _near_one(one.density, other.density) and _near(one.friction, other.friction)
		return _shapes_are_equal(one.shape, other.shape) and is_in_place and _near(turned, 0.0) and is_alike

	func _shapes_are_equal(one, other):
		if one.kind != other.kind:
			return false
		for size in one:
			if one[size] != other[size]:
				return false
		return true

	func _hinges_are_mirrored(first, second):
		if first == NONE or second == NONE:
			return first == second
		var one = _character.hinges[first]
		var other = _character.hinges[second]
		var anchors = _anchors_are_mirrored(one.parent_anchor, other.parent_anchor)
		anchors = anchors and _anchors_are_mirrored(one.child_anchor, other.child_anchor)
		var limits = _near(one.limits[0], -other.limits[1]) and _near(one.limits[1], -other.limits[0])
		var are_driven = _character.outputs.has(first) == _character.outputs.has(second)
		return anchors and limits and _motors_are_alike(one.motor, other.motor) and are_driven

	func _anchors_are_mirrored(one, other):
		return _near(one[0], -other[0]) and _near(one[1], other[1])

	func _motors_are_alike(one, other):
		if one == null or other == null:
			return one == other
		return _near_one(one.top_speed, other.top_speed) and _near_one(one.top_torque, other.top_torque)

	# Rounded to 32 bits, as the original: what it takes for a mirror image is one here.
	func _near(one, other):
		return abs(Numbers.single(one - other)) <= Numbers.single(TOLERANCE)

	# Whether their ratio is nearly 1.
	func _near_one(one, other):
		return _near(Numbers.single(one / other), 1.0)


# A body and the controller that moves it. Shared by all that play it; nothing changes it once it is read.
class Character:
	# The name of the creature.
	var name = ""
	# What it has learned: running, playing.
	var movement = ""
	# "right", as it was trained, or "left".
	var facing = "right"
	# What it has learned in: `time_step` (s), `gravity` (m/s², downwards), `ground_friction`, `motor_gain` (N·m per rad/s),
	# `body_length` (m, in which speeds are commanded), `rest_height` (of the torso's centre, m), `self_collision` (two parts
	# that share a hinge never collide) and `water`: null, or `density` (kg/m²), `drag` and `slip`.
	var world = {}
	# Bodies in the pose in which the character starts; the first is the torso. Each has a `name`, a `shape` centred on its
	# place (`kind` is "box" with `width` and `height`, "circle" with `radius`, or "capsule" with `length` between the centres of
	# its half discs along y, and `radius`; m), `x`, `y` (m; the ground is at 0), `angle` (rad), `density` (kg/m²), `friction`
	# (that of a contact is the product with the ground's) and `foot` (whether it is the last part of a leg).
	var parts = []
	# `parent` and `child` (parts), `parent_anchor` and `child_anchor` ([x, y] in the part's own frame, m), `limits` (smallest and
	# largest angle of the child against the parent, rad, against that of the start pose) and `motor`: null, or `top_speed`
	# (rad/s) and `top_torque` (N·m). A motor that is no output is asked for speed 0 for ever.
	var hinges = []
	# Whether outputs ask for angles, with a `gain` (1/s); else for speeds.
	var asks_for_angles = false
	var gain = 0.0
	# The hinge that each output moves, and the node of the net that it is.
	var outputs = []
	var output_nodes = []
	# Inputs of the net lie within plus or minus this.
	var input_range = 1.0
	var inputs = []
	var neurons = []

	# Reads the bytes of a `.player` file. Returns "", or why they are not a character: cut, changed, or out of range. What has
	# failed to be read is not to be played.
	func read(bytes):
		var file = Reader.new(bytes)
		file.header()
		file.list_numbers()
		file.field = "name"
		name = file.text(0)
		file.field = "movement"
		movement = file.text(0)
		if file.is_sound():
			world = file.world()
		parts = []
		for index in range(file.some("parts", SHORTEST_PART)):
			if file.is_sound():
				parts.append(file.part(index))
		_read_hinges(file)
		_read_outputs(file)
		file.field = "input range"
		input_range = file.f32()
		file.within(input_range, 0.001, 1000.0, "input range", 0, "from 0.001 to 1000")
		inputs = []
		for index in range(file.some("inputs", SHORTEST_INPUT)):
			if file.is_sound():
				inputs.append(file.input(index, parts.size(), hinges.size()))
		neurons = []
		for index in range(file.count("neurons", SHORTEST_NEURON)):
			if file.is_sound():
				neurons.append(file.neuron(index))
		file.check(_nodes_are_known(), "neurons", 0, "connected with nodes that are there")
		if file.rest() > 0:
			file.fail("the file does not end with its last field: neurons")
		return file.error

	func _read_hinges(file):
		hinges = []
		var records = file.count("hinges", SHORTEST_HINGE)
		# A body of one part has none.
		file.check(records + 1 == parts.size(), "hinges", 0, "one for each part but the torso")
		var hangs = {}
		for index in range(records):
			if file.is_sound():
				hinges.append(file.hinge(index, parts.size(), hangs))
		file.field = "actuation"
		asks_for_angles = file.code(0, 2, "0 (speed) or 1 (angle)") == 1
		gain = file.f32()
		if asks_for_angles:
			file.within(gain, 0.1, 50.0, "actuation", 0, "with a gain from 0.1 to 50")

	func _read_outputs(file):
		outputs = []
		output_nodes = []
		for index in range(file.some("outputs", SHORTEST_OUTPUT)):
			var hinge = file.u16()
			var is_free = hinge < hinges.size() and hinges[hinge].motor != null and not outputs.has(hinge)
			file.check(is_free, "outputs", index, "a hinge with a motor, listed once")
			outputs.append(hinge)
			output_nodes.append(file.u16())

	func _nodes_are_known():
		var nodes = inputs.size() + neurons.size()
		for node in output_nodes:
			if node >= nodes:
				return false
		for neuron in neurons:
			for source in neuron.sources:
				if source >= nodes:
					return false
		return nodes <= MOST_NODES

	# The same character, facing the other way: its parts and hinges are those to build, and its player takes and gives what
	# belongs to that body.
	func mirrored():
		var other = get_script().new()
		for field in ["name", "movement", "world", "asks_for_angles", "gain", "outputs", "output_nodes"]:
			other.set(field, get(field))
		for field in ["input_range", "inputs", "neurons"]:
			other.set(field, get(field))
		other.facing = "left" if facing == "right" else "right"
		for part in parts:
			var mirrored_part = part.duplicate()
			mirrored_part.x = -part.x
			mirrored_part.angle = -part.angle
			other.parts.append(mirrored_part)
		for hinge in hinges:
			var mirrored_hinge = hinge.duplicate()
			mirrored_hinge.parent_anchor = [-hinge.parent_anchor[0], hinge.parent_anchor[1]]
			mirrored_hinge.child_anchor = [-hinge.child_anchor[0], hinge.child_anchor[1]]
			mirrored_hinge.limits = Numbers.mirrored_limits(hinge.limits)
			other.hinges.append(mirrored_hinge)
		return other

	# What the game has to measure every frame, in the order in which `Player.tick` takes it; nothing for most characters.
	# `kind` is a Source:
	# - RAY: the distance from the torso's centre to the first thing that is not the character, along `angle` (in the world,
	#   rad; 0 looks towards greater x); `length` (m) if there is none;
	# - GAP_DISTANCE: the distance from the torso's centre to the near edge of the next gap ahead, at least 0; `length` if there
	#   is none;
	# - GAP_WIDTH: the width of that gap, m; 0 if there is none.
	func outside():
		return Numbers.outside_facing(inputs, facing)

	# "" if its body looks the same from both sides, so that its player can turn round: `Player.face`. Or else the first part that
	# has no mirror image, or whose hinge is not that of its mirror image.
	func symmetry():
		return Twins.new(self).error

	# The parts as they start, at rest: a PartState for each.
	func start_pose():
		var states = []
		for part in parts:
			var state = PartState.new()
			state.x = part.x
			state.y = part.y
			state.cosine = cos(part.angle)
			state.sine = sin(part.angle)
			states.append(state)
		return states


# One body that is played: clocks, and memory of the net.
class Player:
	# What is played.
	var character
	# Since the start, s. This and the next three are to be read only.
	var seconds = 0.0
	# The inputs of the net in the last frame.
	var inputs = []
	# What the net put out in the last frame.
	var outputs = []
	# The speed that the motor of each output was last asked for, rad/s: of the child against the parent, counter-clockwise.
	var speeds = []
	# -1 for a body that faces left now, else 1.
	var _side = 1.0
	# Which part and which output takes the place of which, or null if the body was built to face as it does.
	var _twins = null
	# Of the torso, and of each hinge: cosine and sine in the start pose.
	var _rest_torso
	var _rest_hinges = []
	# Limits of each output's hinge, as the net knows them.
	var _limits = []
	var _outside_count = 0
	# Inputs, and what each neuron put out last.
	var _nodes = []
	# The parts as the net knows them: facing right.
	var _parts = []
	var _joint_angles = []
	var _torques = []
	var _ground = 0.0
	var _landed = 0.0
	var _touched = true
	var _commanded_speed = 0.0
	var _jump = false
	var _since_press = NEVER
	var _stride_began = 0.0
	var _step = 0.0

	# A body that stands in its start pose, its clocks at 0.
	func _init(character_):
		character = character_
		var side = _side_of(character.facing)
		_outside_count = character.outside().size()
		_parts = character.start_pose()
		# The net knows the body as it was trained: facing right.
		_rest_torso = _direction(side * character.parts[0].angle)
		for hinge in character.hinges:
			var angle = character.parts[hinge.child].angle - character.parts[hinge.parent].angle
			_rest_hinges.append(_direction(side * Numbers.single(angle)))
		for output in character.outputs:
			var limits = character.hinges[output].limits
			_limits.append(limits if side > 0.0 else Numbers.mirrored_limits(limits))
		inputs.resize(character.inputs.size())
		outputs.resize(character.outputs.size())
		speeds.resize(character.outputs.size())
		_torques.resize(character.outputs.size())
		_joint_angles.resize(character.hinges.size())
		_nodes.resize(character.inputs.size() + character.neurons.size())
		reset()

	# Begins anew: clocks at 0, the net without memory, facing as it was built. Call it when the body was put back into its
	# start pose.
	func reset():
		_side = _side_of(character.facing)
		_twins = null
		_forget()
		_clear(speeds)
		seconds = 0.0
		# A body that stands as its clock starts.
		_landed = 0.0
		_touched = true
		_commanded_speed = 0.0
		_jump = false
		_since_press = NEVER
		_stride_began = 0.0
		_step = 0.0

	# How high the ground is where the body stands, m; 0 until it is said, and unchanged by what is not finite. Only a character that
	# senses the height of its torso goes by it. One that was trained on a terrain that rises or falls heard its height above the
	# ground it started on: tell it the height of that.
	func set_ground(height):
		if Numbers.is_finite_number(height):
			_ground = height

	# Turns round, from the next frame on: "left" or "right". A body that looks the same from both sides (`character.symmetry`)
	# runs the other way with the same net, and what it is told is meant the way it faces. A body that stands turns best; one that
	# runs is told to stand first. Returns "", or why the body does not look the same from both sides; it goes on as it was.
	func face(facing_):
		if facing_ != "left" and facing_ != "right":
			return "\"%s\": must be \"left\" or \"right\"" % facing_
		if facing_ == facing():
			return ""
		var twins = null if facing_ == character.facing else Twins.new(character)
		if twins != null and twins.error != "":
			return twins.error
		_twins = twins
		_side = _side_of(facing_)
		return ""

	# Which way it faces: "left" or "right".
	func facing():
		return "left" if _side < 0.0 else "right"

	# What the game has to measure every frame, as `character.outside()`, the way it faces now.
	func outside():
		return Numbers.outside_facing(character.inputs, facing())

	func _side_of(facing_):
		return -1.0 if facing_ == "left" else 1.0

	# A frame: what the body does now, what is outside of it, and what it is told. Returns "", and `speeds` holds what the
	# motors are asked for until the next, in the order of `character.outputs`.
	# - `parts`: a PartState for each, in the order of `character.parts`;
	# - `outside`: what the game measures, in the order of `outside()`;
	# - `command`: a Command;
	# - `frame`: how long this frame lasts, from 0 to 1 s.
	#
	# Returns what is wrong if there are too few or too many parts or measurements, or a number is not finite. The motors are
	# then asked for speed 0.
	func tick(parts, outside, command, frame):
		var error = _control(parts, outside, command, frame)
		if error != "":
			_clear(speeds)
		if error == NOT_FINITE:
			_forget()
		return error

	# The torque of the motor of each output, N·m, counter-clockwise on the child and as much the other way on the parent, for
	# bodies whose hinges have no motors: in proportion to the speed that is lacking, up to the motor's top torque. May be asked
	# for at every step of the engine, several times a frame. The next call writes over it. 0 where a spin is not finite. A motor
	# that is no output gets none here: the game holds it still by the same law, asked for speed 0.
	func torques(parts):
		for index in range(_torques.size()):
			var hinge = character.hinges[character.outputs[index]]
			var lacking = speeds[index] - (_spin(parts, hinge.child) - _spin(parts, hinge.parent))
			var most = hinge.motor.top_torque
			var wanted = lacking * character.world.motor_gain if Numbers.is_finite_number(lacking) else 0.0
			_torques[index] = clamp(wanted, -most, most)
		return _torques

	func _spin(parts, part):
		return parts[part].spin if part < parts.size() else 0.0

	# Cosine and sine.
	func _direction(angle):
		return Vector2(cos(angle), sin(angle))

	func _clear(numbers):
		for index in range(numbers.size()):
			numbers[index] = 0.0

	func _forget():
		_clear(_nodes)
		_clear(inputs)
		_clear(outputs)

	# Why the frame could not be played, or "".
	func _control(parts, outside, command, frame):
		if parts.size() != _parts.size():
			return "%d parts, and the character has %d" % [parts.size(), _parts.size()]
		if outside.size() != _outside_count:
			var counts = [outside.size(), _outside_count]
			return "%d measurements of what is outside, and the character wants %d" % counts
		var step = Numbers.single(frame)
		if not (step >= 0.0 and step <= LONGEST_FRAME):
			return "the time of a frame must be from 0 to 1 s"
		var finite = Numbers.is_finite_number(command.speed)
		for index in range(_parts.size()):
			var from = index if _twins == null else _twins.parts[index]
			finite = _take(_parts[index], parts[from]) and finite
		for number in outside:
			finite = Numbers.is_finite_number(number) and finite
		if not finite:
			return NOT_FINITE
		_sense_joints()
		var time = Numbers.single(seconds)
		_observe_landing(time)
		var pressed = command.jump and not _jump
		_since_press = 0.0 if pressed else Numbers.single(_since_press + _step)
		if pressed or (command.speed != 0 and _commanded_speed == 0):
			_stride_began = time
		_commanded_speed = command.speed
		_jump = command.jump
		_step = step
		seconds += step
		_sense(outside, time)
		_activate()
		for index in range(speeds.size()):
			var asked = _asked(index)
			if not Numbers.is_finite_number(asked):
				return NOT_FINITE
			speeds[index if _twins == null else _twins.outputs[index]] = _side * asked
		return ""

	# Copies a part as the net knows it; whether all its numbers are finite.
	func _take(own, part):
		own.x = _side * part.x
		own.y = part.y
		own.cosine = part.cosine
		own.sine = _side * part.sine
		own.vx = _side * part.vx
		own.vy = part.vy
		own.spin = _side * part.spin
		own.touching = part.touching
		var place = (own.x - own.x) + (own.y - own.y) + (own.cosine - own.cosine) + (own.sine - own.sine)
		return place + (own.vx - own.vx) + (own.vy - own.vy) + (own.spin - own.spin) == 0.0

	func _sense_joints():
		for index in range(_joint_angles.size()):
			var hinge = character.hinges[index]
			var from = _parts[hinge.parent]
			var to = _parts[hinge.child]
			var direction = Numbers.turned_back(Vector2(from.cosine, from.sine), Vector2(to.cosine, to.sine))
			_joint_angles[index] = Numbers.angle_from(_rest_hinges[index], direction)

	func _observe_landing(time):
		var touches = false
		for part in _parts:
			touches = touches or part.touching
		if touches and not _touched and Numbers.single(time - _landed) >= Numbers.single(ONE_LANDING):
			_landed = time
		_touched = touches

	func _sense(outside, time):
		var measured = 0
		for index in range(inputs.size()):
			var probe = character.inputs[index]
			var value = 0.0
			if Numbers.is_outside(probe.source):
				value = outside[measured]
				measured += 1
			else:
				value = _read(probe, time)
			var scaled = Numbers.single(Numbers.single(Numbers.single(value) - probe.middle) * probe.factor)
			inputs[index] = clamp(scaled, -character.input_range, character.input_range)
			_nodes[index] = inputs[index]

	func _read(probe, time):
		var torso = _parts[0]
		match probe.source:
			Source.TORSO_ROTATION:
				return Numbers.angle_from(_rest_torso, Vector2(torso.cosine, torso.sine))
			Source.TORSO_SPIN:
				return torso.spin
			Source.JOINT_ANGLE:
				return _joint_angles[probe.of]
			Source.JOINT_SPEED:
				var hinge = character.hinges[probe.of]
				return _parts[hinge.child].spin - _parts[hinge.parent].spin
			Source.VELOCITY_FORWARD:
				return torso.vx
			Source.VELOCITY_UP:
				return torso.vy
			Source.TORSO_HEIGHT:
				return torso.y - (_ground + character.world.rest_height)
			Source.CONTACT:
				return 1.0 if _parts[probe.of].touching else 0.0
			Source.SLIP:
				return _slip(_parts[probe.of], character.parts[probe.of].shape)
			Source.CLOCK_SINE:
				return sin(Numbers.clock_phase(time, probe.first))
			Source.CLOCK_COSINE:
				return cos(Numbers.clock_phase(time, probe.first))
			Source.LANDING_SINE:
				return sin(Numbers.clock_phase(Numbers.single(time - _landed), probe.first))
			Source.LANDING_COSINE:
				return cos(Numbers.clock_phase(Numbers.single(time - _landed), probe.first))
			Source.COMMANDED_SPEED:
				return _commanded_speed
			Source.JUMP_COMMAND:
				return 1.0 if _jump else 0.0
			Source.STRIDE_SINE:
				return _stride_swing(probe.second) * sin(Numbers.clock_phase(Numbers.single(time - _stride_began), probe.first))
			Source.STRIDE_COSINE:
				return _stride_swing(probe.second) * cos(Numbers.clock_phase(Numbers.single(time - _stride_began), probe.first))
			Source.JUMP_SINE:
				return sin(_jump_phase(probe.first))
			_:
				return 0.5 * (1.0 - cos(_jump_phase(probe.first)))

	# Forward velocity of the point below the centre, m/s; 0 where nothing touches.
	func _slip(part, shape):
		if not part.touching:
			return 0.0
		return part.vx + part.spin * Numbers.half_height(shape, part.cosine, part.sine)

	func _stride_swing(top):
		return clamp(_commanded_speed / top, -1.0, 1.0)

	# 0 once the turn is over.
	func _jump_phase(period):
		return _since_press / period * TAU if _since_press < period else 0.0

	func _activate():
		var node = inputs.size()
		for neuron in character.neurons:
			var sum = neuron.bias
			var sources = neuron.sources
			var weights = neuron.weights
			for index in range(sources.size()):
				# The numbers of a vector have 32 bits: sums are rounded as the original rounds them, and fast.
				var product = Vector2(weights[index] * _nodes[sources[index]], 0.0)
				sum = Vector2(sum + product.x, 0.0).x
			_nodes[node] = Vector2(Numbers.activated(neuron.activation, sum) * neuron.scale, 0.0).x
			node += 1
		for index in range(outputs.size()):
			outputs[index] = _nodes[character.output_nodes[index]]

	func _asked(index):
		var hinge = character.outputs[index]
		var wanted = clamp(outputs[index], -1.0, 1.0)
		var top_speed = character.hinges[hinge].motor.top_speed
		if not character.asks_for_angles:
			return wanted * top_speed
		var low = _limits[index][0]
		var high = _limits[index][1]
		var target = clamp(Numbers.single(wanted * max(abs(low), abs(high))), low, high)
		return clamp(Numbers.single(target - _joint_angles[hinge]) * character.gain, -top_speed, top_speed)
