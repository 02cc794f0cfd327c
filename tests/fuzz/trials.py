"""Mutations by kind: the files that each writes and the command that it types."""

import mutations
import seeds


class Trial:
    """One mutation: files in a folder of its own, and the commands to run there."""

    def __init__(self, number, rng, folder, prepared):
        self.number, self.rng, self.folder, self.prepared = number, rng, folder, prepared
        self.mutate = mutations.Mutator(rng)
        self.commands = []
        self.expected = None  # (file, content) of what a success must leave
        for name, content in seeds.FILES.items():
            self.write(name, content)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8", "surrogatepass"))

    def times(self, change, content):
        for _ in range(self.rng.choice([1, 1, 1, 2, 3])):
            content = change(content)
        return content

    def command(self, *words):
        self.commands.append([str(word).replace("\x00", "?") for word in words])

    def scene_file(self, name, verbs=("check", "run")):
        verb = self.rng.choice(verbs)
        self.command(verb, name, *(["-o", "out"] if verb == "run" else []))

    # --- kinds of mutation ---

    def scene(self):
        text = seeds.SCENES[self.rng.choice(list(seeds.SCENES))]
        self.write("scene.prm", self.times(self.mutate.scene, text))
        self.scene_file("scene.prm")

    def scene_in_json(self):
        text = seeds.SCENES[self.rng.choice(list(seeds.SCENES))]
        self.write("scene.json", mutations.json_scene(self.mutate, text))
        self.scene_file("scene.json")

    def override(self):
        text = seeds.SCENES[self.rng.choice(list(seeds.SCENES))]
        self.write("scene.prm", text)
        keys, path = [], []
        for line in text.split("\n"):
            line = line.split("#")[0].strip()
            if line.startswith("subsection "):
                path.append(line[11:])
            elif line == "end":
                path.pop()
            elif line.startswith("set "):
                key, value = line[4:].split("=", 1)
                keys.append(("/".join(path + [key.strip()]), value.strip()))
        words = []
        for key, value in self.rng.sample(keys, self.rng.choice([1, 1, 2])):
            words += ["-s", f"{key}={self.mutate.value(value)}"]
        verb = self.rng.choice(["check", "run"])
        self.command(verb, "scene.prm", *words, *(["-o", "out"] if verb == "run" else []))

    def use_packing(self, name, periodic):
        pick = self.rng.random()
        if pick < 0.3 or (periodic and pick < 0.5):
            self.command("homogenise", name, "--interaction-ratio", self.rng.choice(["1.5", "1.4", "1", "2.5"]),
                         "--normal-modulus", "25e9", "--shear-ratio", "0.2", "--solver",
                         self.rng.choice(["automatic", "iterative", "direct"]), "-o", "out")
        elif pick < 0.6:
            self.command("pack", "--from", name, "--box", "0.012,0.012,0.012", "-o",
                         self.rng.choice(["new.txt", "new.h5", "new.csv"]))
        else:
            kind = self.rng.choice(["cell", "homogenisation"] if periodic else ["uniaxial", "quasi_static"])
            text = seeds.SCENES[kind].replace("cell.txt" if periodic else "packing.txt", name)
            self.write("scene.prm", text)
            self.scene_file("scene.prm")

    def packing_text(self):
        periodic = self.rng.random() < 0.5
        source = "cell.txt" if periodic else "packing.txt"
        self.write("p.txt", self.times(self.mutate.lines, seeds.FILES[source]))
        self.use_packing("p.txt", periodic)

    def packing_hdf5(self):
        periodic = self.rng.random() < 0.5
        name = "cell" if periodic else "packing"
        sound = self.prepared[f"{name}.h5"]
        if self.rng.random() < 0.4:  # what no program wrote is noticed, or changes nothing
            self.write("p.h5", self.times(self.mutate.bytes, sound))
            self.command("pack", "--from", "p.h5", "-o", "new.txt")
            self.expected = ("new.txt", self.prepared[f"{name} as text"])
        else:
            self.write("p.h5", self.times(self.mutate.hdf5, sound))
            self.use_packing("p.h5", periodic)

    def mesh(self):
        name = self.rng.choice(["two.msh", "two4.msh"])
        self.write("two.msh", self.times(self.mutate.lines, seeds.FILES[name]))
        self.write("scene.prm", seeds.CONTINUUM_STATIC)
        self.scene_file("scene.prm")

    def path(self):
        link = self.rng.random() < 0.5
        text = seeds.LINK_PATH if link else seeds.POINT_PATH
        constants = list(seeds.LINK_CONSTANTS if link else seeds.POINT_CONSTANTS)
        if self.rng.random() < 0.7:
            text = self.times(self.mutate.lines, text)
        else:
            at = self.rng.randrange(len(constants))
            key, value = constants[at].split("=")
            constants[at] = f"{key}={self.mutate.value(value)}"
        self.write("path.csv", text)
        words = [word for constant in constants for word in ("-s", constant)]
        if link:
            self.command("link-test", "--law", self.rng.choice(["CPM", "cpm"]), *words, "--path", "path.csv")
        else:
            self.command("point-test", "--material", "damage-plastic concrete", *words, "--path", "path.csv")

    def state(self):
        self.write("state.h5", self.times(self.mutate.hdf5, self.prepared["state.h5"]))
        text = seeds.SEQUENTIAL.replace("  set Source = uniaxial\n", "  set Source = file\n  set Files = state.h5\n", 1)
        self.write("scene.prm", text)
        self.command(self.rng.choice(["transfer", "run"]), "scene.prm", "-o", "out")

    def checkpoint(self):
        kind = self.rng.choice(sorted(self.prepared["interrupted"]))
        files = dict(self.prepared["interrupted"][kind])
        mine = [name for name in files if name.endswith("checkpoint.h5")]
        if self.rng.random() < 0.7:
            files[mine[0]] = self.times(self.mutate.hdf5, files[mine[0]])
        else:
            name = self.rng.choice(sorted(set(files) - set(mine)))
            if self.rng.random() < 0.3:
                del files[name]
            elif name.endswith(".h5"):
                files[name] = self.mutate.hdf5(files[name])
            else:
                files[name] = self.mutate.bytes(files[name])
        for name, content in files.items():
            self.write(name, content)
        self.write("scene.prm", seeds.SCENES[kind])
        self.command("run", "scene.prm", "-o", "out", "--resume", *self.prepared["slow"][kind])

    def command_line(self):
        number = self.mutate.number
        words = [
            ["pack", "--radius", number("1e-3"), "--count", self.rng.choice(["20", number("20")]), "-o", "new.txt"],
            ["pack", "--radius", "1e-3", "--count", "20", "--seed", number("1"), "-o", "new.txt"],
            ["pack", "--radius", "1e-3", "--count", "20", "--friction", number("1"), "--damping", self.rng.choice(
                ["0.6", number("0.6")]), "-o", "new.txt"],
            ["pack", "--from", "cell.txt", "--box", ",".join(number("0.01") for _ in range(3)), "-o", "new.txt"],
            ["homogenise", "cell.txt", "--interaction-ratio", number("1.5"), "--normal-modulus", number("25e9"),
             "--shear-ratio", number("0.2"), "-o", "out"],
            ["homogenise", "cell.txt", "--interaction-ratio", "1.5", "--normal-modulus", "25e9", "--shear-ratio", "0.2",
             "--tolerance", number("1e-10"), "--thickness", number("1")],
            ["envelope", "-s", "Element size=" + number("1"), "-s", "Compressive strength=" + number("30e6")],
            [self.rng.choice(["run", "check", "describe", "transfer", "pack"]), self.rng.choice(mutations.NASTY_WORDS)],
        ]
        self.command(*self.rng.choice(words))

    KINDS = (("scene", 5), ("scene_in_json", 2), ("override", 3), ("packing_text", 3), ("packing_hdf5", 2), ("mesh", 3),
             ("path", 3), ("state", 2), ("checkpoint", 3), ("command_line", 2))

    def draw(self):
        names, weights = zip(*self.KINDS)
        self.kind = self.rng.choices(names, weights)[0]
        getattr(self, self.kind)()
