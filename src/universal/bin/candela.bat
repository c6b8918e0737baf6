@echo off
rem Starts Candela with the newest JDK on this machine, 17 or later, or with the Java runtime in the
rem program's folder: a JDK must be newer, and have the module of the SIMD kernels, to replace that.
rem   CANDELA_JAVA  folder of the JDK to use instead
rem   JAVA_OPTS     additional JVM options, such as -Xmx4g
setlocal EnableExtensions
for %%L in ("%~dp0..\lib") do set "LIB=%%~fL"
for %%L in ("%~dp0..\runtime") do set "BUNDLED=%%~fL"
set "BEST=0"
set "HOME_FOUND="
if defined CANDELA_JAVA call :consider "%CANDELA_JAVA%"
if not defined CANDELA_JAVA call :search
if %BEST% LSS 17 (
  echo candela: no JDK 17 or newer found. 1>&2
  echo candela: Install one, for example from https://adoptium.net, or set CANDELA_JAVA to its folder. 1>&2
  exit /b 2
)
set "NATIVES=windows-x64"
if /i "%PROCESSOR_ARCHITECTURE%"=="ARM64" set "NATIVES=windows-arm64"
rem Since JDK 19, Java maintains the class-data archive itself.
set "ARCHIVE=-Dcandela.archive=none"
if %BEST% GEQ 19 if defined LOCALAPPDATA (
  if not exist "%LOCALAPPDATA%\candela" mkdir "%LOCALAPPDATA%\candela" 2>nul
  set "ARCHIVE=-XX:+AutoCreateSharedArchive -XX:SharedArchiveFile="%LOCALAPPDATA%\candela\classes-%BEST%.jsa" -Xlog:cds*=off"
)
rem JDK 25 knows options that earlier ones refuse.
set "OPTIONS=%LIB%\options"
if %BEST% GEQ 25 set "OPTIONS=%LIB%\options-25"
rem Java refuses two collectors: one that is asked for replaces ours.
set "COLLECTOR="
for %%O in (%JAVA_OPTS%) do call :collector "%%~O"
"%HOME_FOUND%\bin\java.exe" %ARCHIVE% "@%OPTIONS%" %COLLECTOR% "-Dorg.lwjgl.librarypath=%LIB%\natives\%NATIVES%" %JAVA_OPTS% -cp "%LIB%\candela.jar" candela.cli.Main %*
exit /b %ERRORLEVEL%

:collector
for %%C in (G1 Serial Z Shenandoah Epsilon) do if "%~1"=="-XX:+Use%%CGC" set "COLLECTOR=-XX:-UseParallelGC"
exit /b 0

:search
call :consider "%BUNDLED%"
if defined JAVA_HOME call :consider "%JAVA_HOME%"
for %%F in ("%ProgramFiles%\Java" "%ProgramFiles%\Eclipse Adoptium" "%ProgramFiles%\Microsoft" ^
  "%ProgramFiles%\Amazon Corretto" "%ProgramFiles%\Zulu" "%USERPROFILE%\.jdks") do call :within %%F
exit /b 0

:within
for /d %%D in ("%~1\*") do call :consider "%%~D"
exit /b 0

:consider
if not exist "%~1\bin\java.exe" exit /b 0
if not exist "%~1\release" exit /b 0
if "%HOME_FOUND%"=="%BUNDLED%" (findstr /c:"jdk.incubator.vector" "%~1\release" >nul || exit /b 0)
for /f "usebackq tokens=1,2 delims==" %%K in ("%~1\release") do if "%%K"=="JAVA_VERSION" call :compare "%~1" %%L
exit /b 0

:compare
for /f "delims=.-+ " %%M in ("%~2") do set "MAJOR=%%M"
if %MAJOR% LEQ %BEST% exit /b 0
set "BEST=%MAJOR%"
set "HOME_FOUND=%~1"
exit /b 0
