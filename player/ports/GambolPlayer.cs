// Plays a trained character of Gambol: from the state of its body to the speeds of its motors, once a frame.
//
// Copy this file into a game; it is plain C# 7 for .NET, Mono and Unity, and needs nothing else. docs/player.md is the
// specification of the file format and of everything that is computed. MIT OR Apache-2.0. Tested with Mono 6.8; it has not
// been run in Unity.
//
//     var character = Character.FromBytes(File.ReadAllBytes("biped.player"));
//     var player = new Player(character); // after a body is built from character.Parts and character.Hinges
//     float[] speeds = player.Tick(parts, outside, new Command { Speed = 1 }, 1f / 60f);
//
// Units: metres, kilograms, seconds, radians; x points forward, y up; angles count counter-clockwise. Numbers are rounded
// to 32 bits where the original rounds them (casts say so, for some runtimes compute with more); only Exp, Tanh, Sin, Cos
// and Atan2 are the language's own.

using System;
using System.Linq;
using System.Text;

namespace Gambol
{
    /// <summary>Why bytes are not a character.</summary>
    public sealed class FileError : Exception
    {
        internal FileError(string message) : base(message) { }
    }

    /// <summary>Why a frame could not be played. Its motors hold still.</summary>
    public sealed class TickError : Exception
    {
        internal TickError(string message) : base(message) { }
    }

    /// <summary>Why a body does not look the same from both sides.</summary>
    public sealed class Asymmetry : Exception
    {
        internal Asymmetry(string message) : base(message) { }
    }

    /// <summary>Where a part of the body is and how it moves.</summary>
    public struct PartState
    {
        /// <summary>Centre, forward, m.</summary>
        public float X;
        /// <summary>Centre, up, m.</summary>
        public float Y;
        /// <summary>Cosine of its angle against the world, counter-clockwise.</summary>
        public float Cos;
        /// <summary>Sine of that angle.</summary>
        public float Sin;
        /// <summary>Velocity of the centre, forward, m/s.</summary>
        public float Vx;
        /// <summary>Velocity of the centre, up, m/s.</summary>
        public float Vy;
        /// <summary>Angular speed, counter-clockwise, rad/s.</summary>
        public float Spin;
        /// <summary>Whether it touches the ground.</summary>
        public bool Touching;

        /// <summary>A part that rests at a place (m), turned by an angle (rad).</summary>
        public static PartState At(float x, float y, float angle)
        {
            // Some runtimes give back an angle beyond 2⁶³ instead of its cosine.
            var turned = angle % (2.0 * Math.PI);
            return new PartState { X = x, Y = y, Cos = (float)Math.Cos(turned), Sin = (float)Math.Sin(turned) };
        }

        /// <summary>As seen by one that looks the other way.</summary>
        public PartState Mirrored()
        {
            var mirrored = this;
            mirrored.X = -X;
            mirrored.Sin = -Sin;
            mirrored.Vx = -Vx;
            mirrored.Spin = -Spin;
            return mirrored;
        }

        internal bool IsFinite
        {
            get
            {
                // Differences of what is not finite are not 0.
                return X - X + (Y - Y) + (Cos - Cos) + (Sin - Sin) + (Vx - Vx) + (Vy - Vy) + (Spin - Spin) == 0;
            }
        }
    }

    /// <summary>What the character is told to do.</summary>
    public struct Command
    {
        /// <summary>How fast to go, body lengths/s, the way the character faces; backwards below 0. Values beyond what it was
        /// trained for count as the fastest.</summary>
        public float Speed;
        /// <summary>Whether the button that means jump is held.</summary>
        public bool Jump;
    }

    /// <summary>Which way a body faces: towards greater x, as it was trained, or its mirror image.</summary>
    public enum Facing { Right, Left }

    /// <summary>The kinds of shapes.</summary>
    public enum ShapeKind { Box, Circle, Capsule }

    /// <summary>The solid shape of a part, centred on the part's place.</summary>
    public sealed class Shape
    {
        public ShapeKind Kind;
        /// <summary>Full sizes of a box along the part's x and y axes, m; else 0.</summary>
        public float Width, Height;
        /// <summary>Of a capsule: distance between the centres of its half discs, along the part's y axis, m; else 0.</summary>
        public float Length;
        /// <summary>Of a circle or of a capsule's half discs, m; else 0.</summary>
        public float Radius;

        /// <summary>Height of the lowest point above the centre, m (so never positive), when the shape is turned by the angle
        /// whose cosine and sine are given.</summary>
        public float LowestPoint(float cos, float sin)
        {
            float c = Math.Abs(cos), s = Math.Abs(sin);
            if (Kind == ShapeKind.Box) return -0.5f * (s * Width + c * Height);
            // The length of a circle is 0.
            return -(0.5f * c * Length + Radius);
        }
    }

    /// <summary>A rigid body in the pose in which the character starts.</summary>
    public sealed class Part
    {
        public string Name;
        public Shape Shape;
        /// <summary>Centre, m, x forward and y up; the ground is at 0.</summary>
        public float X, Y;
        /// <summary>Turned counter-clockwise, rad.</summary>
        public float Angle;
        /// <summary>Mass per area, kg/m².</summary>
        public float Density;
        /// <summary>Coulomb friction coefficient; that of a contact is the product with the ground's.</summary>
        public float Friction;
        /// <summary>Whether it is a foot: the last part of a leg.</summary>
        public bool Foot;
    }

    /// <summary>What drives a hinge: the fastest it turns, rad/s, and the most it gives, N·m.</summary>
    public sealed class Motor
    {
        public float TopSpeed, TopTorque;
    }

    /// <summary>What holds two parts together.</summary>
    public sealed class Hinge
    {
        /// <summary>The part it hangs on, and the part that hangs on it.</summary>
        public int Parent, Child;
        /// <summary>The hinge in the parent's and in the child's own frame, m: x and y.</summary>
        public float[] ParentAnchor, ChildAnchor;
        /// <summary>Smallest and largest angle of the child against the parent, rad, against that of the start pose.</summary>
        public float[] Limits;
        /// <summary>Null: it turns freely. A motor that is no output of the net is asked for speed 0 for ever.</summary>
        public Motor Motor;
    }

    /// <summary>Water all around: mass per area, kg/m², and drag coefficients across and along a part's long side.</summary>
    public sealed class Water
    {
        public float Density, Drag, Slip;
    }

    /// <summary>The world a character has learned in: a game that is like it is played best.</summary>
    public sealed class World
    {
        /// <summary>Time of a step, s.</summary>
        public float TimeStep;
        /// <summary>Downwards, m/s².</summary>
        public float Gravity;
        /// <summary>Friction coefficient of the ground.</summary>
        public float GroundFriction;
        /// <summary>Torque of a motor, per speed that it lacks, N·m per rad/s, up to its top torque.</summary>
        public float MotorGain;
        /// <summary>The length in which speeds are commanded, m.</summary>
        public float BodyLength;
        /// <summary>Height of the torso's centre above the ground, at rest, m.</summary>
        public float RestHeight;
        /// <summary>Null: nothing but air and ground.</summary>
        public Water Water;
        /// <summary>Whether parts of the body collide with each other; two that share a hinge never do.</summary>
        public bool SelfCollision;
    }

    /// <summary>What a channel of the senses shows, with its number in a file.</summary>
    public enum Source
    {
        TorsoRotation, TorsoSpin, JointAngle, JointSpeed, VelocityForward, VelocityUp, TorsoHeight, Contact, Ray, Slip,
        GapDistance, GapWidth, ClockSine, ClockCosine, LandingSine, LandingCosine, CommandedSpeed, JumpCommand, StrideSine,
        StrideCosine, JumpSine, JumpSwell
    }

    /// <summary>Where an input of the net comes from: (value − middle) · factor.</summary>
    public sealed class Probe
    {
        public Source Source;
        /// <summary>Its part or hinge.</summary>
        public int Of;
        /// <summary>Settings, as docs/player.md lists them for each source.</summary>
        public float First, Second;
        public float Middle, Factor;
    }

    /// <summary>Something that the game itself has to measure, since only it knows what is there.</summary>
    public sealed class Outside
    {
        /// <summary>
        /// Ray: the distance from the torso's centre to the first thing that is not the character, along a ray that does not turn
        /// with the torso; Length if there is none. GapDistance: from the torso's centre to the near edge of the next gap ahead, at
        /// least 0; Length if there is none. GapWidth: the width of that gap; 0 if there is none.
        /// </summary>
        public Source Kind;
        /// <summary>Of a ray, in the world, counter-clockwise, rad; 0 looks towards greater x.</summary>
        public float Angle;
        /// <summary>m.</summary>
        public float Length;
    }

    /// <summary>The function that turns the sum of a neuron into its output, with its number in a file.</summary>
    public enum Activation { Logistic, Tanh, RationalTanh, Relu, Linear, Sine, Gaussian, SteepLogistic, SteepTanh }

    /// <summary>A neuron: scale · activation(bias + Σ weight · source). Sources are inputs, from 0, and then neurons.</summary>
    public sealed class Neuron
    {
        public Activation Activation;
        public float Scale, Bias;
        public int[] Sources;
        public float[] Weights;
    }

    /// <summary>A body and the controller that moves it. Shared by all that play it; nothing changes it.</summary>
    public sealed class Character
    {
        /// <summary>The version of the format that is read.</summary>
        public const int Version = 2;

        /// <summary>The name of the creature, and what it has learned: "running", "playing".</summary>
        public string Name, Movement;
        public Facing Facing;
        public World World;
        /// <summary>What it is made of; the first is the torso.</summary>
        public Part[] Parts;
        public Hinge[] Hinges;
        /// <summary>Whether outputs ask for angles; else for speeds.</summary>
        public bool AsksForAngles;
        /// <summary>Speed asked for, per angle that is lacking, 1/s.</summary>
        public float Gain;
        /// <summary>The hinge that each output moves, and the node of the net that it is.</summary>
        public int[] Outputs, OutputNodes;
        /// <summary>Inputs of the net lie within ± this.</summary>
        public float InputRange;
        public Probe[] Inputs;
        public Neuron[] Neurons;

        internal Character() { }

        /// <summary>Reads the bytes of a `.player` file. Throws a FileError if they are cut, changed, or out of range.</summary>
        public static Character FromBytes(byte[] bytes)
        {
            return Reader.Read(bytes);
        }

        /// <summary>The same character, facing the other way: its parts and hinges are those to build, and its player takes and
        /// gives what belongs to that body.</summary>
        public Character Mirrored()
        {
            var mirrored = (Character)MemberwiseClone();
            mirrored.Facing = Facing == Facing.Right ? Facing.Left : Facing.Right;
            mirrored.Parts = Parts.Select(MirroredPart).ToArray();
            mirrored.Hinges = Hinges.Select(MirroredHinge).ToArray();
            return mirrored;
        }

        /// <summary>What the game has to measure every frame, in the order in which Player.Tick takes it; nothing for most
        /// characters.</summary>
        public Outside[] Outside()
        {
            return OutsideFacing(Facing);
        }

        /// <summary>Whether its body looks the same from both sides, so that its player can turn round: Player.Face. Throws an
        /// Asymmetry that names the first part that has no mirror image, or whose hinge is not that of its mirror
        /// image.</summary>
        public void Symmetry()
        {
            new Twins(this);
        }

        /// <summary>The parts as they start, at rest.</summary>
        public PartState[] StartPose()
        {
            return Parts.Select(part => PartState.At(part.X, part.Y, part.Angle)).ToArray();
        }

        internal static bool IsOutside(Source source)
        {
            return source == Source.Ray || source == Source.GapDistance || source == Source.GapWidth;
        }

        internal static float[] MirroredLimits(float[] limits)
        {
            return new[] { -limits[1], -limits[0] };
        }

        internal Outside[] OutsideFacing(Facing facing)
        {
            return Inputs.Where(probe => IsOutside(probe.Source)).Select(probe => OutsideOf(probe, facing)).ToArray();
        }

        private static Outside OutsideOf(Probe probe, Facing facing)
        {
            if (probe.Source != Source.Ray) return new Outside { Kind = probe.Source, Length = probe.First };
            var angle = facing == Facing.Left ? (float)Math.PI - probe.First : probe.First;
            return new Outside { Kind = Source.Ray, Angle = angle, Length = probe.Second };
        }

        private static Part MirroredPart(Part part)
        {
            return new Part
            {
                Name = part.Name, Shape = part.Shape, X = -part.X, Y = part.Y, Angle = -part.Angle, Density = part.Density,
                Friction = part.Friction, Foot = part.Foot
            };
        }

        private static Hinge MirroredHinge(Hinge hinge)
        {
            return new Hinge
            {
                Parent = hinge.Parent,
                Child = hinge.Child,
                ParentAnchor = new[] { -hinge.ParentAnchor[0], hinge.ParentAnchor[1] },
                ChildAnchor = new[] { -hinge.ChildAnchor[0], hinge.ChildAnchor[1] },
                Limits = MirroredLimits(hinge.Limits),
                Motor = hinge.Motor
            };
        }
    }

    /// <summary>Which part, and which output, is the mirror image of each.</summary>
    internal sealed class Twins
    {
        /// <summary>Lengths may differ by so much, m, and angles, rad: files hold decimals.</summary>
        private const float Tolerance = 1e-4f;
        private const float Turn = (float)(2.0 * Math.PI);
        private const int None = -1;

        internal readonly int[] Parts, Outputs;
        private readonly Character character;
        /// <summary>The hinge that each part hangs on; null for the torso.</summary>
        private readonly Hinge[] hangs;

        /// <summary>Of a body: across the upright line through the torso; a part in the middle is its own. Throws an Asymmetry
        /// for the first part, or hinge, that has no mirror image.</summary>
        internal Twins(Character character)
        {
            this.character = character;
            Parts = character.Parts.Select(_ => None).ToArray();
            hangs = new Hinge[Parts.Length];
            foreach (var hinge in character.Hinges) hangs[hinge.Child] = hinge;
            for (var part = 0; part < Parts.Length; part++) if (Parts[part] == None) Match(part);
            Outputs = character.Outputs.Select(OutputTwin).ToArray();
        }

        private void Match(int part)
        {
            var candidates = Enumerable.Range(part, Parts.Length - part).Where(other => MayBeTwins(part, other)).ToArray();
            if (candidates.Length == 0) throw new Asymmetry($"part {part} has no mirror image on the other side");
            var fitting = candidates.Where(other => HingesAreMirrored(hangs[part], hangs[other])).Take(1).ToArray();
            if (fitting.Length == 0)
                throw new Asymmetry($"the hinge of part {part} is not the mirror image of that of its twin");
            Parts[part] = fitting[0];
            Parts[fitting[0]] = part;
        }

        private int OutputTwin(int hinge)
        {
            var twin = Parts[character.Hinges[hinge].Child];
            return Array.FindIndex(character.Outputs, other => character.Hinges[other].Child == twin);
        }

        private bool MayBeTwins(int part, int other)
        {
            var above = hangs[part] == null ? None : Parts[hangs[part].Parent];
            var otherAbove = hangs[other] == null ? None : hangs[other].Parent;
            var free = Parts[other] == None && otherAbove == above;
            return free && AreMirrored(character.Parts[part], character.Parts[other], character.Parts[0].X);
        }

        private static bool AreMirrored(Part one, Part other, float middle)
        {
            // After half a turn a part looks the same, but its angle, which is sensed, is not.
            var turns = (float)((float)(one.Angle + other.Angle) / Turn);
            var turned = Near((float)((float)(turns - (float)Math.Round(turns)) * Turn), 0f);
            var inPlace = Near((float)(one.X - middle), (float)(middle - other.X)) && Near(one.Y, other.Y) && turned;
            var material = Near((float)(one.Density / other.Density), 1f) && Near(one.Friction, other.Friction);
            return ShapesAreEqual(one.Shape, other.Shape) && inPlace && material;
        }

        private static bool ShapesAreEqual(Shape one, Shape other)
        {
            var boxes = one.Width == other.Width && one.Height == other.Height;
            return one.Kind == other.Kind && boxes && one.Length == other.Length && one.Radius == other.Radius;
        }

        private bool HingesAreMirrored(Hinge one, Hinge other)
        {
            if (one == null || other == null) return one == other;
            var anchors = AnchorsAreMirrored(one.ParentAnchor, other.ParentAnchor)
                && AnchorsAreMirrored(one.ChildAnchor, other.ChildAnchor);
            var limits = Near(one.Limits[0], -other.Limits[1]) && Near(one.Limits[1], -other.Limits[0]);
            return anchors && limits && MotorsAreAlike(one.Motor, other.Motor) && IsActuated(one) == IsActuated(other);
        }

        private bool IsActuated(Hinge hinge)
        {
            return character.Outputs.Any(output => character.Hinges[output] == hinge);
        }

        private static bool AnchorsAreMirrored(float[] one, float[] other)
        {
            return Near(one[0], -other[0]) && Near(one[1], other[1]);
        }

        private static bool MotorsAreAlike(Motor one, Motor other)
        {
            if (one == null || other == null) return one == other;
            return Near((float)(one.TopSpeed / other.TopSpeed), 1f) && Near((float)(one.TopTorque / other.TopTorque), 1f);
        }

        // With 32 bits, as the original: what it takes for a mirror image is one here.
        private static bool Near(float one, float other) => Math.Abs((float)(one - other)) <= Tolerance;
    }

    /// <summary>Reads fields one after the other, the lowest byte first.</summary>
    internal sealed class Reader
    {
        private const int Header = 24, MostNodes = 65536;
        // The shortest records, in bytes: a count that promises more than the file holds is not believed.
        private const int Number = 4, ShortestPart = 10, ShortestHinge = 9, ShortestOutput = 2, ShortestInput = 6;
        private const int ShortestNeuron = 4, ShortestSource = 2;

        private readonly byte[] bytes;
        private int at;
        /// <summary>What is read, for errors.</summary>
        private string field = "header";
        /// <summary>The numbers that the rest of the file points at.</summary>
        private float[] numbers = { };

        private Reader(byte[] bytes)
        {
            this.bytes = bytes;
        }

        internal static Character Read(byte[] bytes)
        {
            const string magic = "GAMBOLPL";
            if (bytes.Length < Header || magic.Where((letter, index) => bytes[index] != letter).Any())
                throw new FileError("not a character of Gambol: write one with `gambol export --to player`");
            var file = new Reader(bytes) { at = magic.Length };
            uint version = file.U32(), expected = file.U32();
            if (version != Character.Version)
                throw new FileError($"version {version} of the format; this player reads version {Character.Version}");
            var found = bytes.Length - Header;
            if (expected != found)
                throw new FileError($"{found} bytes after the header, which says {expected}: the file was cut or added to");
            var digest = file.U32() | (ulong)file.U32() << 32;
            if (digest != Digest(bytes))
                throw new FileError("the digest does not fit: the file was changed after it was written");
            return file.ReadCharacter();
        }

        /// <summary>FNV-1a, 64 bits, of what follows the header.</summary>
        private static ulong Digest(byte[] bytes)
        {
            var digest = 0xcbf29ce484222325;
            for (var index = Header; index < bytes.Length; index++) digest = unchecked((digest ^ bytes[index]) * 0x100000001b3);
            return digest;
        }

        private static void Check(bool holds, string field, int index, string allowed)
        {
            if (!holds) throw new FileError($"{field}, number {index}: must be {allowed}");
        }

        private static void Within(float number, float low, float high, string field, int index, string allowed)
        {
            Check(number >= low && number <= high, field, index, allowed);
        }

        private static void Finite(string field, int index, params float[] numbers)
        {
            var finite = numbers.All(number => !float.IsNaN(number) && !float.IsInfinity(number));
            Check(finite, field, index, "of finite numbers");
        }

        private void Need(long count)
        {
            if (count > bytes.Length - at) throw new FileError($"the file does not end with its last field: {field}");
        }

        private byte U8()
        {
            Need(1);
            return bytes[at++];
        }

        /// <summary>Seven bits a byte, the lowest first; the eighth says that another byte follows.</summary>
        private ushort U16()
        {
            var whole = 0;
            for (var place = 0; place < 3; place++)
            {
                var next = U8();
                whole |= (next & 0x7f) << 7 * place;
                if (next < 0x80 && whole < 65536) return (ushort)whole;
            }
            throw new FileError($"{field}, number 0: must be of whole numbers from 0 to 65535, in at most three bytes");
        }

        private uint U32()
        {
            Need(4);
            at += 4;
            return bytes[at - 4] | (uint)bytes[at - 3] << 8 | (uint)bytes[at - 2] << 16 | (uint)bytes[at - 1] << 24;
        }

        /// <summary>One of the numbers at the beginning.</summary>
        private float F32()
        {
            int index = U16();
            Check(index < numbers.Length, field, 0, "of numbers that are listed");
            return numbers[index];
        }

        private float[] F32s(int count)
        {
            return List(count, _ => F32());
        }

        private int Code(int index, int count, string allowed)
        {
            var code = U8();
            Check(code < count, field, index, allowed);
            return code;
        }

        private bool Flag(int index)
        {
            return Code(index, 2, "0 or 1 where it says yes or no") == 1;
        }

        private string Text(int index)
        {
            var length = U8();
            Need(length);
            at += length;
            try
            {
                return new UTF8Encoding(false, true).GetString(bytes, at - length, length);
            }
            catch (ArgumentException)
            {
                throw new FileError($"{field}, number {index}: must be named in UTF-8");
            }
        }

        /// <summary>The number of records, each at least `shortest` bytes long.</summary>
        private int Count(string named, int shortest)
        {
            field = named;
            var count = U16();
            Need((long)count * shortest);
            return count;
        }

        private static T[] List<T>(int count, Func<int, T> record)
        {
            var list = new T[count];
            for (var index = 0; index < count; index++) list[index] = record(index);
            return list;
        }

        private T[] Some<T>(string named, int shortest, Func<int, T> record)
        {
            var count = Count(named, shortest);
            Check(count > 0, field, 0, "from 1 to 65535 of them");
            return List(count, record);
        }

        private Character ReadCharacter()
        {
            var character = new Character();
            numbers = List(Count("numbers", Number), _ => BitConverter.ToSingle(BitConverter.GetBytes(U32()), 0));
            field = "name";
            character.Name = Text(0);
            field = "movement";
            character.Movement = Text(0);
            character.World = ReadWorld();
            character.Parts = Some("parts", ShortestPart, ReadPart);
            var hingeCount = Count("hinges", ShortestHinge);
            // A body of one part has none.
            Check(hingeCount + 1 == character.Parts.Length, field, 0, "one for each part but the torso");
            var hangs = new bool[character.Parts.Length];
            character.Hinges = List(hingeCount, index => ReadHinge(index, hangs));
            field = "actuation";
            character.AsksForAngles = Code(0, 2, "0 (speed) or 1 (angle)") == 1;
            character.Gain = F32();
            if (character.AsksForAngles) Within(character.Gain, 0.1f, 50f, field, 0, "with a gain from 0.1 to 50");
            Outputs(character);
            field = "input range";
            character.InputRange = F32();
            Within(character.InputRange, 0.001f, 1000f, field, 0, "from 0.001 to 1000");
            character.Inputs = Some("inputs", ShortestInput, index => ReadProbe(index, character));
            character.Neurons = List(Count("neurons", ShortestNeuron), ReadNeuron);
            var nodes = character.Inputs.Length + character.Neurons.Length;
            var named = character.OutputNodes.Concat(character.Neurons.SelectMany(neuron => neuron.Sources));
            var known = nodes <= MostNodes && named.All(node => node < nodes);
            Check(known, field, 0, "connected with nodes that are there");
            if (at != bytes.Length) throw new FileError("the file does not end with its last field: neurons");
            return character;
        }

        private void Outputs(Character character)
        {
            var records = Some("outputs", ShortestOutput, _ => new int[] { U16(), U16() });
            character.Outputs = records.Select(record => record[0]).ToArray();
            character.OutputNodes = records.Select(record => record[1]).ToArray();
            var free = character.Hinges.Select(hinge => hinge.Motor != null).ToArray();
            for (var index = 0; index < records.Length; index++)
            {
                var hinge = character.Outputs[index];
                Check(hinge < free.Length && free[hinge], field, index, "a hinge with a motor, listed once");
                free[hinge] = false;
            }
        }

        private World ReadWorld()
        {
            field = "world";
            var world = new World
            {
                TimeStep = F32(), Gravity = F32(), GroundFriction = F32(), MotorGain = F32(), BodyLength = F32(),
                RestHeight = F32(), SelfCollision = Flag(0)
            };
            if (Flag(0)) world.Water = new Water { Density = F32(), Drag = F32(), Slip = F32() };
            Within(world.TimeStep, 0.001f, 0.05f, "time step", 0, "from 0.001 to 0.05 s");
            Within(world.Gravity, 0f, 100f, "gravity", 0, "from 0 to 100 m/s²");
            Within(world.GroundFriction, 0f, 10f, "ground friction", 0, "from 0 to 10");
            Within(world.MotorGain, 0.01f, 1e6f, "motor gain", 0, "from 0.01 to 1e6");
            Within(world.BodyLength, 0.001f, 1e4f, "body length", 0, "from 0.001 to 10000 m");
            Finite("rest height", 0, world.RestHeight);
            if (world.Water == null) return world;
            Within(world.Water.Density, 0.01f, 1e5f, "water density", 0, "from 0.01 to 1e5 kg/m²");
            Within(world.Water.Drag, 0f, 10f, "water drag", 0, "from 0 to 10");
            Within(world.Water.Slip, 0f, world.Water.Drag, "water slip", 0, "from 0 to the drag");
            return world;
        }

        private Part ReadPart(int index)
        {
            var part = new Part { Name = Text(index) };
            var kind = (ShapeKind)Code(index, 3, "a box (0), a circle (1) or a capsule (2)");
            float first = F32(), second = F32();
            if (kind == ShapeKind.Box) part.Shape = new Shape { Kind = kind, Width = first, Height = second };
            else if (kind == ShapeKind.Circle) part.Shape = new Shape { Kind = kind, Radius = first };
            else part.Shape = new Shape { Kind = kind, Length = first, Radius = second };
            part.X = F32();
            part.Y = F32();
            part.Angle = F32();
            part.Density = F32();
            part.Friction = F32();
            part.Foot = Flag(index);
            Finite(field, index, part.X, part.Y, part.Angle);
            Within(part.Density, 0.1f, 1e4f, field, index, "as dense as 0.1 to 10000 kg/m²");
            Within(part.Friction, 0f, 10f, field, index, "with a friction from 0 to 10");
            Within(first, 0.005f, 50f, field, index, "of sizes from 0.005 to 50 m");
            if (kind != ShapeKind.Circle) Within(second, 0.005f, 50f, field, index, "of sizes from 0.005 to 50 m");
            return part;
        }

        /// <summary>`hangs`: for each part whether it hangs on an earlier hinge.</summary>
        private Hinge ReadHinge(int index, bool[] hangs)
        {
            var hinge = new Hinge
            {
                Parent = U16(), Child = U16(), ParentAnchor = F32s(2), ChildAnchor = F32s(2), Limits = F32s(2)
            };
            if (Flag(index)) hinge.Motor = new Motor { TopSpeed = F32(), TopTorque = F32() };
            var fits = hinge.Parent < hinge.Child && hinge.Child < hangs.Length && !hangs[hinge.Child];
            Check(fits, field, index, "between a part and a later one that hangs on no other");
            hangs[hinge.Child] = true;
            Finite(field, index, hinge.ParentAnchor);
            Finite(field, index, hinge.ChildAnchor);
            Within(hinge.Limits[0], -10f, 0f, field, index, "limited from at most 0 to at least 0, within ± 10 rad");
            Within(hinge.Limits[1], 0f, 10f, field, index, "limited from at most 0 to at least 0, within ± 10 rad");
            if (hinge.Motor == null) return hinge;
            Within(hinge.Motor.TopSpeed, 0.01f, 100f, field, index, "with a top speed from 0.01 to 100 rad/s");
            Within(hinge.Motor.TopTorque, 0.01f, 1e5f, field, index, "with a top torque from 0.01 to 1e5 N·m");
            return hinge;
        }

        private Probe ReadProbe(int index, Character character)
        {
            var code = U8();
            var probe = new Probe
            {
                Source = (Source)code, Of = U16(), First = F32(), Second = F32(), Middle = F32(), Factor = F32()
            };
            Check(code <= (int)Source.JumpSwell, field, index, "a sensor that this player knows");
            Finite(field, index, probe.Middle, probe.Factor);
            switch (probe.Source)
            {
                case Source.JointAngle:
                case Source.JointSpeed:
                    Check(probe.Of < character.Hinges.Length, field, index, "of a hinge that is there");
                    break;
                case Source.Contact:
                case Source.Slip:
                    Check(probe.Of < character.Parts.Length, field, index, "of a part that is there");
                    break;
                case Source.Ray:
                    Finite(field, index, probe.First);
                    Within(probe.Second, 0f, 1000f, field, index, "with a reach of at most 1000 m");
                    break;
                case Source.GapDistance:
                case Source.GapWidth:
                    Within(probe.First, 0f, 1000f, field, index, "with a reach of at most 1000 m");
                    break;
                default:
                    Clock(index, probe);
                    break;
            }
            return probe;
        }

        private void Clock(int index, Probe probe)
        {
            if (probe.Source < Source.ClockSine) return;
            if (probe.Source == Source.CommandedSpeed || probe.Source == Source.JumpCommand) return;
            Within(probe.First, 0.02f, 100f, field, index, "with a period from 0.02 to 100 s");
            if (probe.Source != Source.StrideSine && probe.Source != Source.StrideCosine) return;
            Within(probe.Second, 0.1f, 20f, field, index, "with a top speed from 0.1 to 20 body lengths/s");
        }

        private Neuron ReadNeuron(int index)
        {
            var activation = (Activation)Code(index, 9, "an activation that this player knows");
            var neuron = new Neuron { Activation = activation, Scale = F32(), Bias = F32() };
            var count = Count("neurons", ShortestSource);
            neuron.Sources = new int[count];
            neuron.Weights = new float[count];
            for (var source = 0; source < count; source++)
            {
                neuron.Sources[source] = U16();
                neuron.Weights[source] = F32();
            }
            Finite(field, index, neuron.Scale, neuron.Bias);
            Finite(field, index, neuron.Weights);
            return neuron;
        }
    }

    /// <summary>One body that is played: clocks, and memory of the net. Allocates while it is made and when it turns round, and
    /// in no frame.</summary>
    public sealed class Player
    {
        /// <summary>The longest a frame may last, s.</summary>
        private const float LongestFrame = 1f;
        /// <summary>What touches within this time of a landing belongs to it, s: feet come down one after the other, and
        /// bounce.</summary>
        private const float OneLanding = 0.2f;
        private const float Turn = (float)(2.0 * Math.PI);
        private const string NotFinite = "a number is not finite; the motors hold still and the net begins anew";

        /// <summary>Cosine and sine.</summary>
        private struct Direction
        {
            internal readonly float Cos, Sin;

            internal Direction(float cos, float sin)
            {
                Cos = cos;
                Sin = sin;
            }

            internal static Direction At(float angle)
            {
                var state = PartState.At(0f, 0f, angle);
                return new Direction(state.Cos, state.Sin);
            }

            internal Direction TurnedBack(Direction by)
            {
                float cos = (float)(by.Cos * Cos) + (float)(by.Sin * Sin), sin = (float)(by.Cos * Sin) - (float)(by.Sin * Cos);
                return new Direction(cos, sin);
            }

            /// <summary>The angle seen from a reference, rad, in (-π, π].</summary>
            internal float AngleFrom(Direction reference)
            {
                var direction = TurnedBack(reference);
                return (float)Math.Atan2(direction.Sin, direction.Cos);
            }
        }

        private struct Drive
        {
            internal int Hinge;
            internal float Low, High, Reach, TopSpeed;
        }

        private readonly Character character;
        private readonly Direction restTorso;
        private readonly Direction[] restHinges;
        private readonly Drive[] drives;
        private readonly int outsideCount;
        /// <summary>Inputs, and what each neuron put out last.</summary>
        private readonly float[] nodes;
        /// <summary>The parts as the net knows them: facing right.</summary>
        private readonly PartState[] parts;
        private readonly float[] jointAngles, inputs, outputs, speeds, torques;
        /// <summary>Which way it faces now.</summary>
        private Facing facing;
        /// <summary>Which part and which output takes the place of which; null if it was built to face as it does.</summary>
        private Twins twins;
        private float ground, landed, sincePress, strideBegan, step;
        private bool touched;
        private double seconds;
        private Command command;

        /// <summary>A body that stands in its start pose, its clocks at 0.</summary>
        public Player(Character character)
        {
            this.character = character;
            var left = character.Facing == Facing.Left;
            // The net knows the body as it was trained: facing right.
            var rest = left ? character.Mirrored().Parts : character.Parts;
            restTorso = Direction.At(rest[0].Angle);
            restHinges = character.Hinges.Select(hinge => RestHinge(rest, hinge)).ToArray();
            drives = character.Outputs.Select(hinge => DriveOf(hinge, left)).ToArray();
            outsideCount = character.Outside().Length;
            nodes = new float[character.Inputs.Length + character.Neurons.Length];
            parts = new PartState[character.Parts.Length];
            jointAngles = new float[character.Hinges.Length];
            inputs = new float[character.Inputs.Length];
            outputs = new float[character.Outputs.Length];
            speeds = new float[character.Outputs.Length];
            torques = new float[character.Outputs.Length];
            Reset();
        }

        /// <summary>Begins anew: clocks at 0, the net without memory, facing as it was built. Call it when the body was put back
        /// into its start pose.</summary>
        public void Reset()
        {
            facing = character.Facing;
            twins = null;
            Array.Clear(nodes, 0, nodes.Length);
            Array.Clear(speeds, 0, speeds.Length);
            // A body that stands as its clock starts.
            touched = true;
            landed = 0f;
            seconds = 0.0;
            command = default(Command);
            sincePress = float.PositiveInfinity;
            strideBegan = 0f;
            step = 0f;
        }

        /// <summary>What is played.</summary>
        public Character Character => character;

        /// <summary>How high the ground is where the body stands, m; 0 until it is said, and unchanged by what is not finite. Only a
        /// character that senses the height of its torso goes by it. One that was trained on a terrain that rises or falls heard
        /// its height above the ground it started on: tell it the height of that.</summary>
        public void SetGround(float height)
        {
            if (IsFinite(height)) ground = height;
        }

        /// <summary>Turns round, from the next frame on. A body that looks the same from both sides (Character.Symmetry) runs the
        /// other way with the same net, and what it is told is meant the way it faces. A body that stands turns best; one that
        /// runs is told to stand first. Throws an Asymmetry if the body does not look the same from both sides; it goes on as it
        /// was.</summary>
        public void Face(Facing towards)
        {
            if (towards == facing) return;
            twins = towards == character.Facing ? null : new Twins(character);
            facing = towards;
        }

        /// <summary>Which way it faces.</summary>
        public Facing Facing => facing;

        /// <summary>What the game has to measure every frame, as Character.Outside(), the way it faces now.</summary>
        public Outside[] Outside()
        {
            return character.OutsideFacing(facing);
        }

        /// <summary>Since the start, s.</summary>
        public double Seconds => seconds;

        /// <summary>The inputs of the net in the last frame. The next call writes over them.</summary>
        public float[] Inputs
        {
            get
            {
                Array.Copy(nodes, inputs, inputs.Length);
                return inputs;
            }
        }

        /// <summary>What the net put out in the last frame. The next call writes over it.</summary>
        public float[] Outputs
        {
            get
            {
                for (var index = 0; index < outputs.Length; index++) outputs[index] = nodes[character.OutputNodes[index]];
                return outputs;
            }
        }

        /// <summary>The speed that the motor of each output was last asked for, rad/s: of the child against the parent,
        /// counter-clockwise. The next frame writes over it.</summary>
        public float[] Speeds => speeds;

        /// <summary>
        /// A frame: what the body does now, what is outside of it, and what it is told; the speeds that its motors are asked for
        /// until the next, rad/s, in the order of Character.Outputs. The next frame writes over them.
        ///
        /// Throws a TickError if there are too few or too many parts or measurements, or a number is not finite. The motors are
        /// then asked for speed 0.
        /// </summary>
        /// <param name="states">Where each part is, in the order of Character.Parts.</param>
        /// <param name="outside">What the game measures, in the order of Outside().</param>
        /// <param name="told">What the character is told to do.</param>
        /// <param name="frame">How long this frame lasts, from 0 to 1 s.</param>
        public float[] Tick(PartState[] states, float[] outside, Command told, float frame)
        {
            var error = Control(states, outside, told, frame);
            if (error == null) return speeds;
            Array.Clear(speeds, 0, speeds.Length);
            if (error == NotFinite) Array.Clear(nodes, 0, nodes.Length);
            throw new TickError(error);
        }

        /// <summary>The torque of the motor of each output, N·m, counter-clockwise on the child and as much the other way on the
        /// parent, for engines whose hinges have no motors: in proportion to the speed that is lacking, up to the motor's top
        /// torque. May be asked for at every step of the engine, several times a frame. The next call writes over it. 0 where a
        /// spin is not finite. A motor that is no output gets none here: the game holds it still by the same law, asked for
        /// speed 0.</summary>
        /// <param name="states">Where each part is, in the order of Character.Parts.</param>
        public float[] Torques(PartState[] states)
        {
            for (var index = 0; index < torques.Length; index++)
            {
                var hinge = character.Hinges[character.Outputs[index]];
                var spin = SpinOf(states, hinge.Child) - SpinOf(states, hinge.Parent);
                var torque = IsFinite(spin) ? (speeds[index] - spin) * character.World.MotorGain : 0f;
                torques[index] = Clamp(torque, -hinge.Motor.TopTorque, hinge.Motor.TopTorque);
            }
            return torques;
        }

        private static float SpinOf(PartState[] states, int part)
        {
            return part < states.Length ? states[part].Spin : 0f;
        }

        private static Direction RestHinge(Part[] rest, Hinge hinge)
        {
            return Direction.At((float)(rest[hinge.Child].Angle - rest[hinge.Parent].Angle));
        }

        private Drive DriveOf(int index, bool left)
        {
            var hinge = character.Hinges[index];
            var limits = left ? Character.MirroredLimits(hinge.Limits) : hinge.Limits;
            var reach = Math.Max(Math.Abs(limits[0]), Math.Abs(limits[1]));
            return new Drive
            {
                Hinge = index, Low = limits[0], High = limits[1], Reach = reach, TopSpeed = hinge.Motor.TopSpeed
            };
        }

        /// <summary>Why the frame could not be played, or null.</summary>
        private string Control(PartState[] states, float[] outside, Command told, float frame)
        {
            if (states.Length != parts.Length) return $"{states.Length} parts, and the character has {parts.Length}";
            if (outside.Length != outsideCount)
                return $"{outside.Length} measurements of what is outside, and the character wants {outsideCount}";
            if (!(frame >= 0f && frame <= LongestFrame)) return "the time of a frame must be from 0 to 1 s";
            if (!AreFinite(states, outside, told)) return NotFinite;
            var left = facing == Facing.Left;
            for (var index = 0; index < parts.Length; index++)
            {
                var from = twins == null ? index : twins.Parts[index];
                parts[index] = left ? states[from].Mirrored() : states[from];
            }
            SenseJoints();
            var time = (float)seconds;
            ObserveLanding(time);
            var pressed = told.Jump && !command.Jump;
            sincePress = pressed ? 0f : (float)(sincePress + step);
            if (pressed || (told.Speed != 0f && command.Speed == 0f)) strideBegan = time;
            command = told;
            step = frame;
            seconds += frame;
            Sense(outside, time);
            Activate();
            for (var index = 0; index < drives.Length; index++)
            {
                var asked = Asked(drives[index], nodes[character.OutputNodes[index]]);
                if (!IsFinite(asked)) return NotFinite;
                speeds[twins == null ? index : twins.Outputs[index]] = left ? -asked : asked;
            }
            return null;
        }

        private static bool AreFinite(PartState[] states, float[] outside, Command told)
        {
            foreach (var state in states) if (!state.IsFinite) return false;
            foreach (var number in outside) if (!IsFinite(number)) return false;
            return IsFinite(told.Speed);
        }

        private void SenseJoints()
        {
            for (var index = 0; index < jointAngles.Length; index++)
            {
                var hinge = character.Hinges[index];
                var direction = DirectionOf(hinge.Child).TurnedBack(DirectionOf(hinge.Parent));
                jointAngles[index] = direction.AngleFrom(restHinges[index]);
            }
        }

        private Direction DirectionOf(int part)
        {
            return new Direction(parts[part].Cos, parts[part].Sin);
        }

        private void ObserveLanding(float time)
        {
            var touches = false;
            foreach (var part in parts) touches |= part.Touching;
            if (touches && !touched && (float)(time - landed) >= OneLanding) landed = time;
            touched = touches;
        }

        private void Sense(float[] outside, float time)
        {
            var measured = 0;
            for (var index = 0; index < character.Inputs.Length; index++)
            {
                var probe = character.Inputs[index];
                var value = Character.IsOutside(probe.Source) ? outside[measured++] : Read(probe, time);
                var scaled = (float)((float)(value - probe.Middle) * probe.Factor);
                nodes[index] = Clamp(scaled, -character.InputRange, character.InputRange);
            }
        }

        private float Read(Probe probe, float time)
        {
            switch (probe.Source)
            {
                case Source.TorsoRotation: return DirectionOf(0).AngleFrom(restTorso);
                case Source.TorsoSpin: return parts[0].Spin;
                case Source.JointAngle: return jointAngles[probe.Of];
                case Source.JointSpeed: return JointSpeed(character.Hinges[probe.Of]);
                case Source.VelocityForward: return parts[0].Vx;
                case Source.VelocityUp: return parts[0].Vy;
                case Source.TorsoHeight: return parts[0].Y - (float)(ground + character.World.RestHeight);
                case Source.Contact: return parts[probe.Of].Touching ? 1f : 0f;
                case Source.Slip: return Slip(probe.Of);
                case Source.ClockSine: return Sin(ClockPhase(time, probe.First));
                case Source.ClockCosine: return Cos(ClockPhase(time, probe.First));
                case Source.LandingSine: return Sin(ClockPhase((float)(time - landed), probe.First));
                case Source.LandingCosine: return Cos(ClockPhase((float)(time - landed), probe.First));
                case Source.CommandedSpeed: return command.Speed;
                case Source.JumpCommand: return command.Jump ? 1f : 0f;
                case Source.StrideSine: return StrideSwing(probe.Second) * Sin(ClockPhase((float)(time - strideBegan), probe.First));
                case Source.StrideCosine: return StrideSwing(probe.Second) * Cos(ClockPhase((float)(time - strideBegan), probe.First));
                case Source.JumpSine: return Sin(JumpPhase(probe.First));
                case Source.JumpSwell: return 0.5f * (1f - Cos(JumpPhase(probe.First)));
                default: return float.NaN;
            }
        }

        private float JointSpeed(Hinge hinge)
        {
            return parts[hinge.Child].Spin - parts[hinge.Parent].Spin;
        }

        /// <summary>Forward velocity of the point below the centre, m/s; 0 where nothing touches.</summary>
        private float Slip(int part)
        {
            var state = parts[part];
            if (!state.Touching) return 0f;
            return state.Vx - state.Spin * character.Parts[part].Shape.LowestPoint(state.Cos, state.Sin);
        }

        private float StrideSwing(float top)
        {
            return Clamp(command.Speed / top, -1f, 1f);
        }

        /// <summary>0 once the turn is over.</summary>
        private float JumpPhase(float period)
        {
            return sincePress < period ? sincePress / period * Turn : 0f;
        }

        private void Activate()
        {
            for (var index = 0; index < character.Neurons.Length; index++)
            {
                var neuron = character.Neurons[index];
                var sum = neuron.Bias;
                for (var source = 0; source < neuron.Sources.Length; source++)
                    sum = (float)(sum + (float)(neuron.Weights[source] * nodes[neuron.Sources[source]]));
                nodes[character.Inputs.Length + index] = Activated(neuron.Activation, sum) * neuron.Scale;
            }
        }

        private float Asked(Drive drive, float output)
        {
            var wanted = Clamp(output, -1f, 1f);
            if (!character.AsksForAngles) return wanted * drive.TopSpeed;
            var target = Clamp((float)(wanted * drive.Reach), drive.Low, drive.High);
            var speed = (float)((float)(target - jointAngles[drive.Hinge]) * character.Gain);
            return Clamp(speed, -drive.TopSpeed, drive.TopSpeed);
        }

        /// <summary>Phase of a clock, both s; rad, 0 to 2π. Whole turns are dropped first: they would cost precision.</summary>
        private static float ClockPhase(float time, float period)
        {
            var turns = (float)(time / period);
            return (float)(turns - (float)Math.Floor(turns)) * Turn;
        }

        /// <summary>The output of a neuron for the weighted sum of its sources.</summary>
        private static float Activated(Activation activation, float a)
        {
            switch (activation)
            {
                case Activation.Logistic: return 1f / (1f + Exp(-a));
                case Activation.Tanh: return (float)Math.Tanh(a);
                case Activation.RationalTanh: return RationalTanh(Clamp(a, -3f, 3f));
                case Activation.Relu: return a < 0f ? 0f : a;
                case Activation.Linear: return a;
                // Limited as the original; NaN for infinities.
                case Activation.Sine: return Sin(Clamp(a, -4294967296f, 4294967296f)) + a * 0f;
                case Activation.Gaussian: return Exp(-(a * a));
                case Activation.SteepLogistic: return 1f / (1f + Exp(-4.9f * a));
                default: return (float)Math.Tanh(2.45f * a);
            }
        }

        private static float RationalTanh(float a)
        {
            return Clamp(a * (27f + a * a) / (27f + 9f * (a * a)), -1f, 1f);
        }

        // Limited as the original, which keeps it finite.
        private static float Exp(float x) => (float)Math.Exp(Clamp(x, -87f, 87f));

        private static float Sin(float x) => (float)Math.Sin(x);

        private static float Cos(float x) => (float)Math.Cos(x);

        private static bool IsFinite(float number) => !float.IsNaN(number) && !float.IsInfinity(number);

        // NaN stays NaN.
        private static float Clamp(float number, float low, float high) => number < low ? low : number > high ? high : number;
    }
}
