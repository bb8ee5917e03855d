// Replays a golden trace with GambolPlayer.cs:
//
//     mcs -langversion:7 -warnaserror -out:check.exe Check.cs ../GambolPlayer.cs
//     mono check.exe all-senses.player all-senses.trace.csv
//
// Prints the greatest difference, and fails where something is wrong. A last column `faces_left` of the trace says when the body
// turns round. Without a trace, prints of each file whether its body looks the same from both sides.

using System;
using System.Globalization;
using System.IO;
using System.Linq;
using Gambol;

internal static class Check
{
    private const double Most = 1e-5;

    /// <summary>What a row of a trace tells a player, and what it must give: seconds, inputs, outputs, speeds.</summary>
    private sealed class Row
    {
        internal PartState[] Parts;
        internal float[] Outside;
        internal Command Command;
        internal float[] Expected;
        internal Facing Facing;

        internal Row(string line, Character character, bool turns)
        {
            var numbers = line.Split(',').Select(number => float.Parse(number, CultureInfo.InvariantCulture)).ToArray();
            Facing = turns && numbers.Last() == 1f ? Facing.Left : Facing.Right;
            if (turns) numbers = numbers.Take(numbers.Length - 1).ToArray();
            int measured = 4 + 8 * character.Parts.Length, outside = character.Outside().Length;
            Parts = character.Parts.Select((_, part) => State(numbers, 4 + 8 * part)).ToArray();
            Outside = numbers.Skip(measured).Take(outside).ToArray();
            Command = new Command { Speed = numbers[2], Jump = numbers[3] != 0f };
            Expected = new[] { numbers[1] }.Concat(numbers.Skip(measured + outside)).ToArray();
        }

        private static PartState State(float[] numbers, int at)
        {
            return new PartState
            {
                X = numbers[at], Y = numbers[at + 1], Cos = numbers[at + 2], Sin = numbers[at + 3], Vx = numbers[at + 4],
                Vy = numbers[at + 5], Spin = numbers[at + 6], Touching = numbers[at + 7] != 0f
            };
        }
    }

    private static int Main(string[] arguments)
    {
        try
        {
            if (!arguments.Last().EndsWith(".csv"))
            {
                foreach (var path in arguments) Console.WriteLine(SymmetryOf(path));
                return 0;
            }
            var bytes = File.ReadAllBytes(arguments[0]);
            var lines = File.ReadAllLines(arguments[1]);
            var character = Character.FromBytes(bytes);
            var columns = lines[0].Split(',');
            var turns = columns.Last() == "faces_left";
            var rows = lines.Skip(1).Select(line => new Row(line, character, turns)).ToArray();
            Replay(character, turns ? columns.Take(columns.Length - 1).ToArray() : columns, rows);
            CheckDamage(bytes);
            CheckMirrored(character, rows);
            CheckFacing(character, rows);
            CheckLopsided(bytes, rows);
            CheckErrors(character, rows[0]);
            Console.WriteLine("checked");
            return 0;
        }
        catch (Exception error)
        {
            Console.Error.WriteLine("wrong: " + error.Message);
            return 1;
        }
    }

    private static void Assert(bool holds, string what)
    {
        if (!holds) throw new Exception(what);
    }

    /// <summary>Whether a body looks the same from both sides, or why not.</summary>
    private static string SymmetryOf(string path)
    {
        try
        {
            Character.FromBytes(File.ReadAllBytes(path)).Symmetry();
            return "symmetric";
        }
        catch (Asymmetry error)
        {
            return error.Message;
        }
    }

    private static void Replay(Character character, string[] columns, Row[] rows)
    {
        var player = new Player(character);
        double greatest = 0.0;
        var where = "anywhere";
        for (var step = 0; step < rows.Length; step++)
        {
            var row = rows[step];
            var seconds = (float)player.Seconds;
            player.Face(row.Facing);
            player.Tick(row.Parts, row.Outside, row.Command, character.World.TimeStep);
            var found = new[] { seconds }.Concat(player.Inputs).Concat(player.Outputs).Concat(player.Speeds).ToArray();
            Assert(found.Length == row.Expected.Length, "the trace has other columns than the player has numbers");
            for (var index = 0; index < found.Length; index++)
            {
                double expected = row.Expected[index];
                var difference = Math.Abs(found[index] - expected) / Math.Max(1.0, Math.Abs(expected));
                Assert(!double.IsNaN(difference), $"not a number in step {step}");
                if (difference <= greatest) continue;
                greatest = difference;
                where = (index == 0 ? "seconds" : columns[columns.Length - found.Length + index]) + $", step {step}";
            }
        }
        Console.WriteLine(FormattableString.Invariant($"greatest difference {greatest:0.00e+0} ({where})"));
        Assert(greatest <= Most, "the difference is above 1e-5");
    }

    private static byte[] Changed(byte[] bytes, int place, int by)
    {
        var changed = (byte[])bytes.Clone();
        changed[place] = (byte)(changed[place] ^ by);
        return changed;
    }

    private static void AssertRefused(byte[] damaged, string why)
    {
        try
        {
            Character.FromBytes(damaged);
        }
        catch (FileError error)
        {
            Assert(error.Message.Contains(why), $"refused with \"{error.Message}\", not \"{why}\"");
            return;
        }
        Assert(false, "a damaged file is played");
    }

    private static void CheckDamage(byte[] bytes)
    {
        for (var place = 0; place < bytes.Length; place++)
        {
            var why = place < 8 ? "not a character" : place < 12 ? "version" : place < 16 ? "cut or" : "digest";
            AssertRefused(Changed(bytes, place, 4), why);
        }
        AssertRefused(bytes.Take(bytes.Length - 1).ToArray(), "the file was cut or added to");
        AssertRefused(bytes.Take(20).ToArray(), "not a character of Gambol");
        AssertRefused(Changed(bytes, 8, 1), "version 3 of the format; this player reads version 2");
    }

    /// <summary>The mirror image does the same the other way.</summary>
    private static void CheckMirrored(Character character, Row[] rows)
    {
        Player right = new Player(character), left = new Player(character.Mirrored());
        foreach (var row in rows)
        {
            right.Face(row.Facing);
            left.Face(row.Facing == Facing.Right ? Facing.Left : Facing.Right);
            var mirrored = row.Parts.Select(part => part.Mirrored()).ToArray();
            var speeds = right.Tick(row.Parts, row.Outside, row.Command, 0.02f);
            var others = left.Tick(mirrored, row.Outside, row.Command, 0.02f);
            Assert(speeds.SequenceEqual(others.Select(speed => -speed)), "the mirror image moves otherwise");
            var torques = right.Torques(row.Parts);
            var theirs = left.Torques(mirrored);
            Assert(torques.SequenceEqual(theirs.Select(torque => -torque)), "the mirror image pushes otherwise");
        }
    }

    /// <summary>A body turns round, and back; rays turn with it.</summary>
    private static void CheckFacing(Character character, Row[] rows)
    {
        var player = new Player(character);
        var begins = player.Facing == Facing.Right && Seen(player.Outside()) == Seen(character.Outside());
        Assert(begins, "it does not begin as it was built");
        player.Face(Facing.Left);
        var turned = player.Facing == Facing.Left && Seen(player.Outside()) == Seen(character.Mirrored().Outside());
        Assert(turned, "it does not look to the left");
        var hasRays = character.Outside().Any(outside => outside.Kind == Source.Ray);
        Assert((Seen(player.Outside()) != Seen(character.Outside())) == hasRays, "rays do not turn");
        player.Face(Facing.Right);
        AssertSame(player, new Player(character), rows, "it does not turn back");
        player.Face(Facing.Left);
        player.Reset();
        Assert(player.Facing == Facing.Right, "it begins anew as it was turned");
        AssertSame(player, new Player(character), rows, "it begins anew as it was turned");
        var built = new Player(character.Mirrored());
        built.Face(Facing.Right);
        built.Reset();
        Assert(built.Facing == Facing.Left, "the mirror image begins anew as it was turned");
    }

    /// <summary>One that does not look the same from both sides goes on as it was.</summary>
    private static void CheckLopsided(byte[] bytes, Row[] rows)
    {
        var character = Character.FromBytes(bytes);
        character.Parts.Last().X += 0.1f;
        Player player = new Player(character), other = new Player(Character.FromBytes(bytes));
        AssertSame(player, other, rows, "a part in another place changes what the net does");
        var message = "no error";
        try
        {
            player.Face(Facing.Left);
        }
        catch (Asymmetry error)
        {
            message = error.Message;
        }
        Assert(message.EndsWith("has no mirror image on the other side"), $"\"{message}\", not that there is no mirror image");
        Assert(player.Facing == Facing.Right, "a body that is not symmetric turns round");
        AssertSame(player, other, rows, "a body that cannot turn does not go on as it was");
        player.Face(Facing.Right);
    }

    private static string Seen(Outside[] outside)
    {
        return string.Join(" ", outside.Select(seen => $"{seen.Kind} {seen.Angle:R} {seen.Length:R}"));
    }

    private static void AssertSame(Player one, Player other, Row[] rows, string what)
    {
        foreach (var row in rows.Take(3))
        {
            var speeds = one.Tick(row.Parts, row.Outside, row.Command, 0.02f);
            Assert(speeds.SequenceEqual(other.Tick(row.Parts, row.Outside, row.Command, 0.02f)), what);
        }
    }

    /// <summary>What a game tells wrongly leaves the motors still.</summary>
    private static void CheckErrors(Character character, Row row)
    {
        var player = new Player(character);
        var first = player.Tick(row.Parts, row.Outside, row.Command, 0.02f).ToArray();
        var fallen = (PartState[])row.Parts.Clone();
        fallen[1].Vx = float.NaN;
        var blown = (PartState[])row.Parts.Clone();
        blown[1].Sin = float.PositiveInfinity;
        var more = row.Outside.Concat(new[] { 1f }).ToArray();
        var unclear = new Command { Speed = float.NaN };
        AssertStill(player, row, row.Parts.Skip(1).ToArray(), row.Outside, row.Command, 0.02f, "parts, and the character has");
        AssertStill(player, row, row.Parts, more, row.Command, 0.02f, "measurements of what is outside");
        AssertStill(player, row, row.Parts, row.Outside, row.Command, -0.1f, "the time of a frame");
        AssertStill(player, row, row.Parts, row.Outside, row.Command, float.NaN, "the time of a frame");
        AssertStill(player, row, fallen, row.Outside, row.Command, 0.02f, "not finite");
        AssertStill(player, row, blown, row.Outside, row.Command, 0.02f, "not finite");
        AssertStill(player, row, row.Parts, row.Outside, unclear, 0.02f, "not finite");
        player.Reset();
        var again = player.Tick(row.Parts, row.Outside, row.Command, 0.02f);
        Assert(again.SequenceEqual(first), "no new start");
    }

    private static void AssertStill(
        Player player, Row row, PartState[] parts, float[] outside, Command command, float seconds, string why)
    {
        var moves = player.Tick(row.Parts, row.Outside, row.Command, 0.02f).Any(speed => speed != 0f);
        Assert(moves, "the motors hold still");
        var message = "no error";
        try
        {
            player.Tick(parts, outside, command, seconds);
        }
        catch (TickError error)
        {
            message = error.Message;
        }
        Assert(message.Contains(why), $"\"{message}\", not \"{why}\"");
        Assert(player.Speeds.All(speed => speed == 0f), "the motors do not hold still");
        var forgets = why != "not finite" || player.Outputs.All(output => output == 0f);
        Assert(forgets, "the net does not begin anew");
    }
}
