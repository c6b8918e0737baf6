"""The render engine: exports the scene, runs candela, shows and delivers its image."""

import os
import queue
import tempfile
import threading
import traceback
from pathlib import Path

import bpy
import numpy as np

from . import export, settings, world
from .candela import CandelaError, InternalError, load
from .candela._session import cancel, close, execute

_IMAGE = "image.npz"
_POLL_SECONDS = 0.1
_CANCEL_SECONDS = 5.0


class Cancelled(Exception):
    """The user has ended the rendering."""


class CandelaRenderEngine(bpy.types.RenderEngine):
    bl_idname = "CANDELA"
    bl_label = "Candela"
    bl_use_preview = False
    bl_use_shading_nodes_custom = False
    bl_use_eevee_viewport = True

    def update_render_passes(self, scene, renderlayer):
        self.register_pass(scene, renderlayer, "Combined", 4, "RGBA", "COLOR")
        if renderlayer.use_pass_z:
            self.register_pass(scene, renderlayer, "Depth", 1, "Z", "VALUE")
        if renderlayer.use_pass_normal:
            self.register_pass(scene, renderlayer, "Normal", 3, "XYZ", "VECTOR")
        if renderlayer.candela.use_pass_albedo:
            self.register_pass(scene, renderlayer, "Albedo", 3, "RGB", "COLOR")

    def render(self, depsgraph):
        try:
            with tempfile.TemporaryDirectory(prefix="candela-", ignore_cleanup_errors=True) as name:
                _Rendering(self, depsgraph, Path(name)).run()
        except Cancelled:
            pass
        except (settings.NoProgram, export.ExportError, CandelaError) as error:
            text = str(error)
            if isinstance(error, InternalError):
                text += f"\nProgram in the add-on's preferences: {os.environ['CANDELA_PROGRAM']}"
            self.report({"ERROR"}, text)
        except Exception as error:  # Blender may crash if it receives one
            traceback.print_exc()
            self.report({"ERROR"}, f"{type(error).__name__}: {error}")


def _on_main_thread(work, is_ended):
    """Runs what reads and writes the open file: Blender renders in a thread of its own."""
    if threading.current_thread() is threading.main_thread():
        return work()
    answers = queue.Queue()

    def answer():
        try:
            answers.put((work(), None))
        except BaseException as error:
            answers.put((None, error))

    bpy.app.timers.register(answer)
    while True:
        try:
            result, error = answers.get(timeout=_POLL_SECONDS)
        except queue.Empty:
            if is_ended() and bpy.app.timers.is_registered(answer):
                bpy.app.timers.unregister(answer)
                raise Cancelled from None
            continue
        if error is not None:
            raise error
        return result


class _Rendering:
    """One frame of one view layer."""

    def __init__(self, engine, depsgraph, folder: Path):
        self.engine, self.depsgraph, self.folder = engine, depsgraph, folder
        self.scene = depsgraph.scene.original
        self.layer = self.scene.view_layers[depsgraph.view_layer.name]
        self.bounds = _bounds(self.scene.render)

    def run(self):
        program = settings.program()
        os.environ["CANDELA_PROGRAM"] = program
        _offer_denoiser()
        self.engine.update_stats("", "Exporting")
        file = _on_main_thread(self._export, self.engine.test_break)
        self.names = export.names(file)
        image = self.folder / _IMAGE
        command = ["render", str(file), "--outfile", str(image), *self._options()]
        self.engine.update_stats("", "Preparing")
        self._execute(command, image)

    def _export(self):
        return export.write(self.scene, self.layer, self.depsgraph, self.folder, self._warn)

    def _warn(self, text):
        self.engine.report({"WARNING"}, text)

    def _options(self):
        own, render = self.scene.candela, self.scene.render
        width, height = _size(render)
        seed = own.seed + (self.scene.frame_current if own.use_animated_seed else 0)
        words = ["--resolution", f"{width}x{height}"]
        # Those that the sampler has: powers of two
        samples = 1 << (own.samples - 1).bit_length()
        words += ["--spp", str(samples), "--seed", str(seed)]
        x0, x1, y0, y1 = self.bounds
        if (x0, x1, y0, y1) != (0, width, 0, height):
            words += ["--pixelbounds", f"{x0},{x1},{height - y1},{height - y0}"]
        if own.time_limit > 0:
            words += ["--time", f"{own.time_limit:g}s"]
        if own.error_limit > 0:
            words += ["--error", f"{own.error_limit:g}%"]
        if own.use_denoising:
            words.append("--denoise")
        if render.film_transparent:
            words += ["--film", "rgba"]
        elif not _is_sky_visible(world.of(self.scene, self.layer)):
            words += ["--sky", "hide"]
        if not self.engine.is_animation and not bpy.app.background:
            words.append("--write-partial-images")
        if render.threads_mode == "FIXED":
            words += ["--nthreads", str(render.threads)]
        layers = [name for name, is_used in self._layers() if is_used]
        return words + [f"--aov={name}" for name in layers]

    def _layers(self):
        return (
            ("position", self.layer.use_pass_z),
            ("shadingnormal", self.layer.use_pass_normal),
            ("albedo", self.layer.candela.use_pass_albedo),
        )

    def _exposure(self):
        """As the add-on Cycles has it, if it is enabled."""
        return getattr(getattr(self.scene, "cycles", None), "film_exposure", 1.0)

    def _execute(self, command, image: Path):
        answers = queue.Queue()
        latest = []

        def work():
            try:
                answers.put(execute(command, progress=lambda p: latest.append(p), image=image)[1])
            except BaseException as error:
                answers.put(error)

        worker = threading.Thread(target=work, daemon=True, name="candela render")
        worker.start()
        shown = None
        while worker.is_alive():
            worker.join(_POLL_SECONDS)
            if latest:
                self._tell(latest[-1])
                del latest[:-1]
            if self.engine.test_break():
                self._cancel(worker)
                break
            shown = self._show(image, shown)
        answer = answers.get()
        is_cancelled = self.engine.test_break()
        if isinstance(answer, CandelaError) and not is_cancelled:
            raise self._named_error(answer)
        if isinstance(answer, BaseException) and not is_cancelled:
            raise answer
        if image.exists():
            self._deliver(load(image))
        for problem in answer if isinstance(answer, list) else []:
            self.engine.report({"WARNING"}, self._named(problem))

    def _cancel(self, worker):
        """Ends the rendering: the image so far is written, if there is one."""
        cancel()
        worker.join(_CANCEL_SECONDS)
        if worker.is_alive():
            close()
            worker.join()

    def _tell(self, progress):
        if progress.done is not None:
            self.engine.update_progress(progress.done)
        self.engine.update_stats("", progress.line)

    def _named(self, problem):
        name = self.names(problem.key) if problem.key else None
        text = problem.text.replace("\n", " ") if name is None else f"{name}: {problem.message}"
        return text.removeprefix("warning: ").removeprefix("error: ")

    def _named_error(self, error):
        errors = [self._named(p) for p in error.problems if p.severity == "error"]
        return type(error)("\n".join(errors) or str(error), error.problems, error.code)

    def _show(self, image: Path, shown):
        """Shows a partial image that was written since; its time."""
        try:
            written = image.stat().st_mtime_ns
            if written != shown:
                self._deliver(load(image), is_final=False)
            return written
        except (OSError, ValueError, CandelaError):
            return shown

    def _deliver(self, image, is_final=True):
        x0, x1, y0, y1 = self.bounds
        engine = self.engine
        result = engine.begin_result(0, 0, x1 - x0, y1 - y0, layer=self.layer.name)
        passes = result.layers[0].passes
        colors = image["Denoised"] if "Denoised" in image else image.rgb
        alpha = image.alpha if image.alpha is not None else np.ones(colors.shape[:2], np.float32)
        _fill(passes, "Combined", np.dstack([colors * self._exposure(), alpha]))
        if "position" in image:
            depth = np.abs(image["position"][..., 2:3])
            _fill(passes, "Depth", np.where(depth == 0, np.float32(1e10), depth))
        if "shadingnormal" in image:
            # From camera space, whose z points forward
            to_world = np.array(self.scene.camera.matrix_world.to_3x3().normalized(), np.float32)
            normals = image["shadingnormal"] * np.array([1, 1, -1], np.float32)
            _fill(passes, "Normal", normals @ to_world.T)
        if "albedo" in image:
            _fill(passes, "Albedo", image["albedo"])
        if is_final:
            engine.end_result(result, cancel=False)
        else:
            engine.update_result(result)
            engine.end_result(result, cancel=True)


def _fill(passes, name, values):
    """Blender has the lowest row first."""
    found = passes.get(name)
    if found is not None:
        found.rect.foreach_set(np.ascontiguousarray(values[::-1], np.float32).ravel())


def _is_sky_visible(sky):
    """As the add-on Cycles has it, if it is enabled."""
    visibility = getattr(sky, "cycles_visibility", None)
    return visibility is None or visibility.camera


def _size(render):
    """Width and height of the whole image."""
    scale = render.resolution_percentage / 100
    return int(render.resolution_x * scale), int(render.resolution_y * scale)


def _bounds(render):
    """The pixels to render: x0, x1, y0, y1, from the lower left corner, without x1 and y1."""
    width, height = _size(render)
    if not render.use_border:
        return 0, width, 0, height
    x0, x1 = int(render.border_min_x * width), int(render.border_max_x * width)
    y0, y1 = int(render.border_min_y * height), int(render.border_max_y * height)
    return x0, max(x1, x0 + 1), y0, max(y1, y0 + 1)


def _offer_denoiser():
    """Open Image Denoise of Blender, if the user names none."""
    if "CANDELA_OIDN" in os.environ:
        return
    root = Path(bpy.utils.resource_path("LOCAL")).parent
    folders = [root / "lib", root / "blender.shared", root.parent / "Frameworks"]
    for folder in folders:
        found = sorted(folder.glob("*OpenImageDenoise.*")) if folder.is_dir() else []
        if found:
            os.environ["CANDELA_OIDN"] = str(found[0])
            return
